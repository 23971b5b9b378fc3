#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <stop_token>
#include <string_view>

#include "io/work_folder.hpp"
#include "view/frame_store.hpp"
#include "view/site.hpp"
#include "view/web_server.hpp"

namespace laneloom::view {

/// Answers the requests to a server that shows its own view, and beside it the file that a page put last.
/// Requests with `view=N` ask for that file. Not thread-safe.
class FileDesk {
 public:
  /// Reads a file into a store, and finishes the store. Is called in a thread of its own. Must not throw, and
  /// must end soon after a stop is requested.
  using Loader =
      std::function<void(const std::filesystem::path& file, FrameStore& store, std::stop_token stop)>;

  /// `own` must outlive this. `max_file_bytes`: the server's, for the views of files.
  FileDesk(const Site& own, Loader load, std::size_t max_file_bytes);
  FileDesk(const FileDesk&) = delete;
  FileDesk& operator=(const FileDesk&) = delete;
  ~FileDesk();

  WebAnswer answer(std::string_view target) const;
  /// Opens a file as `name=…` of the target, in place of the one before. Answers with {"view": N}. The file
  /// is removed when it is shown no longer.
  WebAnswer open(std::string_view target, io::WorkFolder folder);

 private:
  struct Opened;

  const Site& own_;
  Loader load_;
  std::size_t max_file_bytes_;
  std::size_t opened_count_ = 0;
  std::unique_ptr<Opened> opened_;  ///< null: none is open
};

}  // namespace laneloom::view
