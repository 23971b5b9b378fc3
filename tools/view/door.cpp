#include "view/door.hpp"

#include <arpa/inet.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <utility>

namespace laneloom::view {
namespace {

/// The host without its port: "::1" for "[::1]:8642".
std::string_view without_port(std::string_view host) {
  if (!host.empty() && host.front() == '[') {
    const auto end = host.find(']');
    return end == std::string_view::npos ? std::string_view() : host.substr(1, end - 1);
  }
  return host.substr(0, host.find(':'));
}

bool is_ip_address(std::string_view text) {
  const std::string copy(text);
  in6_addr bytes{};
  return inet_pton(AF_INET, copy.c_str(), &bytes) == 1 || inet_pton(AF_INET6, copy.c_str(), &bytes) == 1;
}

/// Whether two secrets are equal. It takes the same time for all texts of one length.
bool equal_secret(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  unsigned difference = 0;
  for (std::size_t i = 0; i < a.size(); ++i) difference |= static_cast<unsigned>(a[i] ^ b[i]);
  return difference == 0;
}

/// The value of `key` in "key=value; other=value", with any separator.
std::string_view value_of(std::string_view list, std::string_view key, char separator) {
  while (!list.empty()) {
    std::string_view item = list.substr(0, list.find(separator));
    list.remove_prefix(std::min(list.size(), item.size() + 1));
    while (!item.empty() && item.front() == ' ') item.remove_prefix(1);
    if (item.size() > key.size() && item.starts_with(key) && item[key.size()] == '=')
      return item.substr(key.size() + 1);
  }
  return {};
}

}  // namespace

Target::Target(std::string_view target) : path(target.substr(0, target.find('?'))) {
  if (path.size() < target.size()) query = target.substr(path.size() + 1);
}

std::string_view Target::value(std::string_view key) const { return value_of(query, key, '&'); }

Door::Door(std::string address, std::string token, std::vector<std::string> program_origins)
    : address_(std::move(address)), token_(std::move(token)), program_origins_(std::move(program_origins)) {}

unsigned Door::judge(const Knock& knock) const {
  if (!is_own_host(knock.host)) return 403;
  if (!is_own_origin(knock)) return 403;
  if (knock.method != (knock.is_file ? "PUT" : "GET")) return 405;
  if (knock.is_file && !is_loopback(address_)) return 403;
  return token_.empty() || brings_token(knock) ? 200 : 401;
}

/// Whether a name is one of this server's. The port does not matter: a tunnel (ssh -L) may have another one
/// at its other end.
bool Door::is_own_host(std::string_view host) const {
  const std::string_view name = without_port(host);
  if (name == address_ || name == "localhost" || is_loopback(name)) return true;
  const bool on_every_address = address_ == "0.0.0.0" || address_ == "::";
  return on_every_address && is_ip_address(name);
}

/// Whether a request comes from an own page or from no page. Programs that are no browsers send no Origin,
/// and neither does a browser for requests of the page itself.
bool Door::is_own_origin(const Knock& knock) const {
  if (knock.origin.empty() || knock.origin == "http://" + std::string(knock.host)) return true;
  return knock.is_for_programs &&
         std::find(program_origins_.begin(), program_origins_.end(), knock.origin) != program_origins_.end();
}

bool Door::brings_token(const Knock& knock) const {
  constexpr std::string_view kBearer = "Bearer ";
  if (knock.authorization.starts_with(kBearer) &&
      equal_secret(knock.authorization.substr(kBearer.size()), token_))
    return true;
  return equal_secret(Target(knock.target).value("token"), token_) ||
         equal_secret(value_of(knock.cookie, cookie_name(), ';'), token_);
}

std::string random_token() {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::random_device random;
  std::string token;
  for (int word = 0; word < 4; ++word) {
    std::uint32_t bits = random();
    for (int digit = 0; digit < 8; ++digit, bits >>= 4U) token += kDigits[bits & 15U];
  }
  return token;
}

bool is_loopback(std::string_view address) {
  return address == "::1" || (address.starts_with("127.") && is_ip_address(address));
}

}  // namespace laneloom::view
