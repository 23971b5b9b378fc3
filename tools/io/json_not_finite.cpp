#include "io/json_not_finite.hpp"

#include <cstddef>

namespace laneloom::io {
namespace {

constexpr std::size_t kBlockBytes = 1U << 16U;

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

}  // namespace

bool is_not_finite(std::string_view text) {
  return text == "NaN" || text == "Infinity" || text == "-Infinity";
}

void NotFiniteQuotes::add(char c, std::string& to) {
  if (in_text_) {
    in_text_ = escaped_ || c != '"';
    escaped_ = !escaped_ && c == '\\';
    to += c;
    return;
  }
  if (in_word_ && !is_letter(c)) {
    to += '"';
    in_word_ = false;
  }
  // The words of JSON itself begin with small letters.
  if (!in_word_ && (c == 'N' || c == 'I')) {
    to += '"';
    in_word_ = true;
  }
  if (sign_held_) to += '-';
  sign_held_ = c == '-';
  if (sign_held_) return;
  in_text_ = c == '"';
  to += c;
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
