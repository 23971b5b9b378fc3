#pragma once

#include <string>

#include "recording/bytes.hpp"

/// Files by their descriptors; closed at the end. All throw std::runtime_error naming the file.
namespace laneloom {

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

  /// All of it, or none: where the disk is full, the file stays as it was before.
  void append(ByteView bytes);

  std::uint64_t size() const { return size_; }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
  FileDescriptor file_;
  std::uint64_t size_ = 0;
};

/// A file that is read from anywhere.
class InputFile {
 public:
  explicit InputFile(const std::string& path);

  /// Fills `to` from `offset` on; all of it must be within the file.
  void read(std::uint64_t offset, std::span<std::uint8_t> to) const;

  /// When it was opened.
  std::uint64_t size() const { return size_; }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
  FileDescriptor file_;
  std::uint64_t size_ = 0;
};

}  // namespace laneloom
