#pragma once

#include <streambuf>
#include <string>
#include <string_view>

/// NaN and Infinity in JSON. The standard has no such numbers, but Python writes them as they are, and Cap'n
/// Proto as texts. As texts they make one value wrong, and not the whole file.
namespace laneloom::io {

/// Whether a text stands for a number that is not finite.
bool is_not_finite(std::string_view text);

/// Copies JSON, and puts NaN, Infinity and -Infinity in quotes where they are values.
class NotFiniteQuotes {
 public:
  /// Appends a character, and a quote if one is needed before it.
  void add(char c, std::string& to);

 private:
  bool in_text_ = false, escaped_ = false;
  bool in_word_ = false;    ///< of a number that is not finite
  bool sign_held_ = false;  ///< a minus that is not written yet
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
