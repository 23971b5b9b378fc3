#include "io/json_not_finite.hpp"

#include <algorithm>
#include <cstddef>

namespace laneloom::io {
namespace {

constexpr std::size_t kBlockBytes = 1U << 16U;
constexpr std::string_view kNan = "nan", kInf = "inf";  // of the same length

char small(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

bool same_letters(std::string_view one, std::string_view other) {
  return std::ranges::equal(one, other, {}, small, small);
}

std::string_view without_sign(std::string_view token) { return token.substr(token.starts_with('-') ? 1 : 0); }

/// Whether a word begins as another one, as far as both reach.
bool begins_as(std::string_view word, std::string_view known) {
  const std::size_t size = std::min(word.size(), known.size());
  return same_letters(word.substr(0, size), known.substr(0, size));
}

/// Whether a character outside of texts is no part of a number or of a word.
bool ends_token(char c) { return std::string_view(" \t\r\n,:[]{}\"").find(c) != std::string_view::npos; }

}  // namespace

bool is_not_finite(std::string_view text) {
  const std::string_view word = without_sign(text);
  return same_letters(word, kNan) || same_letters(word, kInf) || same_letters(word, "infinity");
}

void NotFiniteQuotes::add(char c, std::string& to) {
  if (in_text_) {
    in_text_ = escaped_ || c != '"';
    escaped_ = !escaped_ && c == '\\';
    to += c;
  } else if (ends_token(c)) {
    end_token(to);
    in_text_ = c == '"';
    to += c;
  } else {
    add_to_token(c, to);
  }
}

void NotFiniteQuotes::add_to_token(char c, std::string& to) {
  if (token_ == Token::plain || token_ == Token::quoted) {
    to += c;
    return;
  }
  token_ = Token::begins;
  begin_ += c;
  const std::string_view word = without_sign(begin_);
  const bool may_be = begins_as(word, kNan) || begins_as(word, kInf);
  if (may_be && word.size() < kNan.size()) return;
  if (may_be) to += '"';
  to += begin_;
  begin_.clear();
  token_ = may_be ? Token::quoted : Token::plain;
}

void NotFiniteQuotes::end_token(std::string& to) {
  to += begin_;
  begin_.clear();
  if (token_ == Token::quoted) to += '"';
  token_ = Token::none;
}

std::string quote_not_finite(std::string_view json) {
  std::string quoted;
  quoted.reserve(json.size() + 16);
  NotFiniteQuotes quotes;
  for (const char c : json) quotes.add(c, quoted);
  quotes.add(' ', quoted);  // ends a word
  return quoted;
}

NotFiniteQuoter::int_type NotFiniteQuoter::underflow() {
  written_.clear();
  while (written_.empty()) {
    read_.resize(kBlockBytes);
    read_.resize(static_cast<std::size_t>(from_.sgetn(read_.data(), kBlockBytes)));
    if (read_.empty()) return traits_type::eof();
    for (const char c : read_) quotes_.add(c, written_);
  }
  setg(written_.data(), written_.data(), written_.data() + written_.size());
  return traits_type::to_int_type(*gptr());
}

}  // namespace laneloom::io
