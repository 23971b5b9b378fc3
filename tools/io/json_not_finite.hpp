#pragma once

#include <cstdint>
#include <streambuf>
#include <string>
#include <string_view>

/// NaN and Infinity in JSON. The standard has no such numbers, but Python writes them as they are, C and
/// others as nan and inf, and Cap'n Proto as texts. As texts they make one value wrong, and not the whole
/// file.
namespace laneloom::io {

/// Whether a text stands for a number that is not finite.
bool is_not_finite(std::string_view text);

/// Copies JSON, and puts in quotes what stands outside of texts and begins as nan or inf, with or without a
/// minus, in small or large letters.
class NotFiniteQuotes {
 public:
  /// Appends a character, and a quote if one is needed before it.
  void add(char c, std::string& to);

 private:
  enum class Token : std::uint8_t { none, begins, plain, quoted };

  void add_to_token(char c, std::string& to);
  void end_token(std::string& to);

  bool in_text_ = false, escaped_ = false;
  Token token_ = Token::none;  ///< what is read outside of texts
  std::string begin_;          ///< of a token, not written yet
};

std::string quote_not_finite(std::string_view json);

/// Does so while a file is read.
class NotFiniteQuoter : public std::streambuf {
 public:
  /// `from` must live as long.
  explicit NotFiniteQuoter(std::streambuf& from) : from_(from) {}

 protected:
  int_type underflow() override;

 private:
  std::streambuf& from_;
  NotFiniteQuotes quotes_;
  std::string read_, written_;
};

}  // namespace laneloom::io
