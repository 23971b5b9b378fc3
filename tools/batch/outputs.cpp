#include "batch/outputs.hpp"

#include <fstream>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include "io/json_text.hpp"
#include "io/text_file.hpp"
#include "replay/map_output.hpp"

namespace laneloom::batch {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr std::size_t kBlock = 1 << 20;

Json read_record(const fs::path& path) {
  std::ifstream file(path);
  Json record = Json::parse(file, nullptr, /*allow_exceptions=*/false);
  return record.is_object() ? record : Json::object();
}

/// What an output was made of is noted beside its part.
fs::path record_of(const fs::path& part) { return part.string() + ".made_of.json"; }

/// Makes the folder of a file, if it may.
fs::path with_folder(const fs::path& file) {
  std::error_code ignored;
  fs::create_directories(file.parent_path(), ignored);
  return file;
}

/// While this is the same, a drive's contents are taken to be.
Json look_of(const fs::path& drive) {
  if (!fs::exists(drive)) throw std::runtime_error(drive.string() + ": there is no such drive");
  return {{"bytes", fs::file_size(drive)},
          {"changed", static_cast<std::int64_t>(fs::last_write_time(drive).time_since_epoch().count())},
          {"path", drive.string()}};
}

Json digests_of(const std::vector<fs::path>& files) {
  Json digests = Json::object();
  for (const fs::path& file : files) digests[file.string()] = digest_of(file);
  return digests;
}

}  // namespace

bool is_output(const fs::path& folder, const fs::path& file) {
  const fs::path below = file.lexically_relative(folder);
  return *below.begin() == kOwnFolder || fs::exists(record_of(folder / kOwnFolder / below));
}

fs::path output_path(const fs::path& folder, const Step& step, const Drive& drive) {
  return folder / (drive.name + kind_of(step).suffix);
}

std::string digest_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error(path.string() + ": cannot be read");
  replay::Digest digest;
  std::vector<std::uint8_t> block(kBlock);
  while (file.read(reinterpret_cast<char*>(block.data()), kBlock) || file.gcount() > 0) {  // NOLINT: bytes
    block.resize(static_cast<std::size_t>(file.gcount()));
    digest.add(block);
    block.resize(kBlock);
  }
  return digest.text();
}

Output::Output(const fs::path& folder, const Step& step, const Drive& drive, const std::string& program)
    : step_(step),
      drive_(drive),
      path_(output_path(folder, step, drive)),
      part_(output_path(folder / kOwnFolder, step, drive)),
      log_(part_.string() + ".log"),
      record_(record_of(part_)),
      lock_(with_folder(part_.string() + ".lock")) {
  noted_ = read_record(record_);
  seen_ = look_of(drive.path);
  made_of_ = {
      {"program", program},
      {"step", step.name},
      {"options", step.options},
      {"files", digests_of(other_inputs(step, drive))},
      {"drive", noted_.value("seen", Json()) == seen_ ? noted_.at("made_of").at("drive").get<std::string>()
                                                      : digest_of(drive.path)}};
}

bool Output::is_made() const {
  return fs::exists(path_) && noted_.value("made_of", Json()) == made_of_ &&
         noted_.value("bytes", Json()) == fs::file_size(path_);
}

bool Output::found_something() const { return noted_.value("found_something", false); }

void Output::begin() const {
  if (fs::exists(path_) && !fs::exists(record_))
    throw std::runtime_error(path_.string() + ": is there, and no batch made it; it is not written over");
  fs::create_directories(path_.parent_path());
  fs::create_directories(part_.parent_path());
  fs::remove(part_);
}

void Output::finish(bool found_something) const {
  if (!fs::exists(part_)) throw std::runtime_error(path_.string() + ": the command wrote nothing");
  if (look_of(drive_.path) != seen_ || digests_of(other_inputs(step_, drive_)) != made_of_.at("files"))
    throw std::runtime_error(path_.string() + ": the drive, or a file of the step, changed meanwhile");
  const Json record{{"made_of", made_of_},
                    {"seen", seen_},
                    {"bytes", fs::file_size(part_)},
                    {"found_something", found_something}};
  io::write_text(record_, "{}\n");  // between the two outputs, the record is that of neither
  fs::rename(part_, path_);
  io::write_text(record_, io::json_text(record, 2) + "\n");
}

}  // namespace laneloom::batch
