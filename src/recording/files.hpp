#pragma once

#include <string>

#include "recording/bytes.hpp"

/// Files by their descriptors, which are closed by the destructors. All throw std::runtime_error naming the
/// file.
namespace laneloom::recording {

class FileDescriptor {
 public:
  explicit FileDescriptor(int descriptor) : descriptor_(descriptor) {}
  ~FileDescriptor();
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;
  int get() const { return descriptor_; }

 private:
  int descriptor_;
};

/// A file that only grows.
class OutputFile {
 public:
  /// The file must not exist yet.
  explicit OutputFile(const std::string& path);

  /// Appends all bytes or none: if the disk is full, the file stays as it was before.
  void append(ByteView bytes);

  std::uint64_t size() const { return size_; }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
  FileDescriptor file_;
  std::uint64_t size_ = 0;
};

/// A file that is read at any offset.
class InputFile {
 public:
  explicit InputFile(const std::string& path);

  /// Fills `to` with the bytes from `offset` on, which must be within the file.
  void read(std::uint64_t offset, std::span<std::uint8_t> to) const;

  /// The size at the time of opening, in bytes.
  std::uint64_t size() const { return size_; }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
  FileDescriptor file_;
  std::uint64_t size_ = 0;
};

}  // namespace laneloom::recording
