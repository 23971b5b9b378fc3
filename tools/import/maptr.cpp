#include "import/maptr.hpp"

#include <string>

#include "io/json_fields.hpp"
#include "io/json_stream.hpp"

namespace laneloom::imports {
namespace {

using nlohmann::json;

void read_vector(const json& vector, FrameCollector& frames) {
  const auto name = io::required(vector, "cls_name", class_name);
  const double sure = io::required(vector, "confidence_level", confidence);
  io::required(vector, "pts", [&](const json& points) {
    frames.add(name, sure, points);
    return true;
  });
}

void read_sample(const json& result, FrameCollector& frames) {
  const bool ours =
      io::required(result, "sample_token", [&](const json& token) { return frames.begin(io::text(token)); });
  if (!ours) return;
  io::required(result, "vectors", [&](const json& vectors) {
    return io::list(vectors, [&](const json& vector) {
      read_vector(vector, frames);
      return true;
    });
  });
  frames.end();
}

}  // namespace

ImportedFrames read_maptr(const std::filesystem::path& path, const DriveLog& drive) {
  FrameCollector frames(drive, "maptr");
  io::for_each_json_object(path, "results", [&](const json& result) { read_sample(result, frames); });
  return std::move(frames).finish(path.string());
}

}  // namespace laneloom::imports
