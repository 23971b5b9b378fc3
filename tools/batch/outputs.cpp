#include "batch/outputs.hpp"

#include <fstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "io/json_text.hpp"
#include "io/text_file.hpp"
#include "replay/map_output.hpp"

namespace laneloom::batch {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kBlock = 1 << 20;

nlohmann::json read_record(const fs::path& path) {
  std::ifstream file(path);
  nlohmann::json record = nlohmann::json::parse(file, nullptr, /*allow_exceptions=*/false);
  return record.is_object() ? record : nlohmann::json::object();
}

/// What an output was made of is noted there.
fs::path record_of(const fs::path& folder, const fs::path& output) {
  return folder / kOwnFolder / (output.string() + ".made_of.json");
}

}  // namespace

bool is_output(const fs::path& folder, const fs::path& file) {
  const fs::path below = file.lexically_relative(folder);
  return *below.begin() == kOwnFolder || fs::exists(record_of(folder, below));
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

Output::Output(const fs::path& folder, const Step& step, const Drive& drive, std::string program)
    : step_(step), drive_(drive), program_(std::move(program)) {
  const std::string name = drive.name + kind_of(step).suffix;
  path_ = output_path(folder, step, drive);
  part_ = folder / kOwnFolder / name;
  record_ = record_of(folder, name);
  log_ = folder / kOwnFolder / (name + ".log");
}

nlohmann::json Output::made_of(const nlohmann::json& before) const {
  nlohmann::json drive{
      {"bytes", fs::file_size(drive_.path)},
      {"changed", static_cast<std::int64_t>(fs::last_write_time(drive_.path).time_since_epoch().count())},
      {"path", drive_.path.string()}};
  const nlohmann::json known = before.value("drive", nlohmann::json::object());
  nlohmann::json without_digest = known;
  without_digest.erase("digest");
  drive["digest"] = without_digest == drive ? known.value("digest", "") : digest_of(drive_.path);
  nlohmann::json files = nlohmann::json::object();
  for (const fs::path& file : other_inputs(step_, drive_)) files[file.string()] = digest_of(file);
  return {{"program", program_},
          {"step", step_.name},
          {"options", step_.options},
          {"files", std::move(files)},
          {"drive", std::move(drive)}};
}

bool Output::is_made() const {
  if (!fs::exists(path_) || !fs::exists(record_)) return false;
  const nlohmann::json before = read_record(record_);
  nlohmann::json was = before, is = made_of(before);
  for (nlohmann::json* one : {&was, &is})
    for (const char* key : {"bytes", "changed", "path"})
      if (one->contains("drive")) (*one)["drive"].erase(key);
  return was == is;
}

void Output::begin() const {
  if (fs::exists(path_) && !fs::exists(record_))
    throw std::runtime_error(path_.string() + ": is there, and no batch made it; it is not written over");
  fs::create_directories(path_.parent_path());
  fs::create_directories(part_.parent_path());
  fs::remove(part_);
}

void Output::finish() const {
  if (!fs::exists(part_)) throw std::runtime_error(path_.string() + ": the command wrote nothing");
  const std::string record = io::json_text(made_of(nlohmann::json::object()), 2) + "\n";
  io::write_text(record_, "{}\n");  // between the two outputs, the record is that of neither
  fs::rename(part_, path_);
  io::write_text(record_, record);
}

}  // namespace laneloom::batch
