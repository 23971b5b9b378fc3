#pragma once

#include <string>
#include <string_view>
#include <vector>

/// Who may ask the viewer's web server for what.
namespace laneloom {

/// What of a request decides whether the request is answered. What a request does not have is empty.
struct Knock {
  std::string_view method, target, host, origin, cookie, authorization;
  bool is_for_programs = false;  ///< asks for the stream that other programs' pages may be allowed to read
};

/// Decides by the rules of one server. Immutable, so thread-safe.
///
/// A page of another site can make a browser send requests here. Such a page is told apart by `Origin`, and
/// one that has its own name point to this host (DNS rebinding) by `Host`.
class Door {
 public:
  /// `address` is what the server listens on. Where `token` is not empty, every request has to bring the
  /// token: in the target (`?token=`), in the cookie `cookie_name()`, or as `Authorization: Bearer`. Pages of
  /// `program_origins` get the stream for programs, and nothing else.
  Door(std::string address, std::string token, std::vector<std::string> program_origins = {});

  /// The status of HTTP that the request deserves: 200, 401 (no token), 403 (foreign Host or Origin), or 405
  /// (not GET).
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
  /// The value of `key`; empty where there is none. Nothing is decoded: no value of ours needs that.
  std::string_view value(std::string_view key) const;

  std::string_view path, query;
};

/// 128 random bits in hexadecimal. Throws std::exception where the system gives none.
std::string random_token();

/// Whether nobody but this host reaches the address.
bool is_loopback(std::string_view address);

}  // namespace laneloom
