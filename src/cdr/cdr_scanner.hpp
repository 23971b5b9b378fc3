#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace laneloom::dds {

/// Walks over a CDR payload without building anything from it. The generated code believes every length that
/// it reads: it throws, or allocates gigabytes. So lengths are checked here first, against the bounds of the
/// IDL and against the bytes that are there.
///
/// A failure is remembered; later calls do nothing.
class CdrScanner {
 public:
  /// `payload` starts with the encapsulation header; only plain CDR is known, as @final types have it.
  explicit CdrScanner(std::span<const std::uint8_t> payload);

  /// Skips `count` numbers of `size` bytes each.
  void numbers(std::size_t size, std::size_t count = 1);
  /// Skips a string of at most `bound` characters.
  void text(std::size_t bound);
  /// Skips a sequence of at most `bound` numbers of `size` bytes each.
  void number_sequence(std::size_t size, std::size_t bound);
  /// Skips a sequence of at most `bound` structs of `per_element` doubles each.
  void double_sequence(std::size_t per_element, std::size_t bound);
  /// Skips a sequence of at most `bound` elements. `element(scanner)` skips one of them.
  template <class Element>
  void sequence(std::size_t bound, Element element) {
    const auto count = length(bound);
    for (std::size_t i = 0; i < count && ok_; ++i) element(*this);
  }

  /// Whether there was no failure so far.
  bool ok() const { return ok_; }
  /// Whether there was no failure and the payload ends here (except for padding).
  bool complete() const;

 private:
  std::size_t length(std::size_t bound);

  std::span<const std::uint8_t> bytes_;
  std::size_t position_ = 0;
  bool little_endian_ = true;
  bool ok_ = true;
};

}  // namespace laneloom::dds
