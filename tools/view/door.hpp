#pragma once

#include <string>
#include <string_view>
#include <vector>

/// The rules that decide who may ask the viewer's web server for what.
namespace laneloom::view {

/// The parts of a request that decide whether it is answered. A part that the request lacks is empty.
struct Knock {
  std::string_view method, target, host, origin, cookie, authorization;
  bool is_for_programs = false;  ///< whether it asks for the stream that pages of other programs may read
  bool is_file = false;          ///< whether it brings a file to the place where files are taken
};

/// Decides by the rules of one server. Immutable, so thread-safe.
///
/// A page of another site can make a browser send requests here. Such a page is recognised by `Origin`. A
/// page whose own name points to this host (DNS rebinding) is recognised by `Host`.
class Door {
 public:
  /// `address` is the address that the server listens on. If `token` is not empty, every request must bring
  /// the token: in the target (`?token=`), in the cookie `cookie_name()`, or as `Authorization: Bearer`.
  /// Pages of `program_origins` get the stream for programs, and nothing else.
  Door(std::string address, std::string token, std::vector<std::string> program_origins = {});

  /// The status of HTTP that the request deserves: 200, 401 (no token), 403 (foreign Host or Origin, or a
  /// file where other hosts reach the server), or 405 (neither GET, nor PUT of a file).
  unsigned judge(const Knock& knock) const;

  const std::string& token() const { return token_; }
  static constexpr std::string_view cookie_name() { return "laneloom_view"; }

 private:
  bool is_own_host(std::string_view host) const;
  bool is_own_origin(const Knock& knock) const;
  bool brings_token(const Knock& knock) const;

  std::string address_, token_;
  std::vector<std::string> program_origins_;
};

/// A target is its path and the values after it: "/frame?number=7".
struct Target {
  explicit Target(std::string_view target);
  /// The value of `key`; empty if there is none. Values are not decoded, since none of ours needs it.
  std::string_view value(std::string_view key) const;

  std::string_view path, query;
};

/// 128 random bits in hexadecimal. Throws std::exception if the system gives none.
std::string random_token();

/// Whether only this host reaches the address.
bool is_loopback(std::string_view address);

}  // namespace laneloom::view
