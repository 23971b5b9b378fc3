#include "view/file_desk.hpp"

#include <algorithm>
#include <string>
#include <system_error>
#include <thread>
#include <utility>

#include "view/door.hpp"

namespace laneloom::view {
namespace {

constexpr std::size_t kMostLetters = 100;

/// Whether a name is one that the page sends: it cannot lead out of a folder, and has no hidden meaning.
bool is_plain(std::string_view name) {
  const auto is_letter = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' ||
           c == '_' || c == '-';
  };
  return !name.empty() && name.size() <= kMostLetters && name.front() != '.' &&
         std::ranges::all_of(name, is_letter);
}

}  // namespace

struct FileDesk::Opened {
  Opened(const Site::Content& content, io::WorkFolder&& in, const Loader& load)
      : folder(std::move(in)),
        site(content, store),
        loader([this, load, file = folder.file(content.title)](const std::stop_token& stop) {
          load(file, store, stop);
        }) {}

  io::WorkFolder folder;
  FrameStore store;
  Site site;
  std::jthread loader;  ///< ends before all that it uses
};

FileDesk::FileDesk(const Site& own, Loader load, std::size_t max_file_bytes)
    : own_(own), load_(std::move(load)), max_file_bytes_(max_file_bytes) {}

FileDesk::~FileDesk() = default;

WebAnswer FileDesk::answer(std::string_view target) const {
  const std::string_view view = Target(target).value("view");
  if (view.empty()) return own_.answer(target);
  if (opened_ && view == std::to_string(opened_count_)) return opened_->site.answer(target);
  return {410, "text/plain", "the file is open no longer\n"};
}

WebAnswer FileDesk::open(std::string_view target, io::WorkFolder folder) {
  const std::string name(Target(target).value("name"));
  if (!is_plain(name))
    return {400, "text/plain", "the file's name must be of letters, digits, '.', '_' and '-'\n"};
  std::error_code failure;
  std::filesystem::rename(folder.file(WebServer::kFileName), folder.file(name), failure);
  if (failure) return {500, "text/plain", failure.message() + "\n"};
  opened_.reset();
  opened_ = std::make_unique<Opened>(Site::Content{.title = name, .max_file_bytes = max_file_bytes_},
                                     std::move(folder), load_);
  return {.body = "{\"view\":" + std::to_string(++opened_count_) + "}"};
}

}  // namespace laneloom::view
