#include "import/maptr.hpp"

#include <string>

#include "io/json_fields.hpp"
#include "io/json_stream.hpp"

namespace laneloom::imports {
namespace {

using nlohmann::json;

void read_vector(const json& vector, FrameCollector& frames) {
  const auto name = io::required(vector, "cls_name", [&](const json& value) {
    std::string text = io::text(value);
    frames.type_of(text);
    return text;
  });
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
  const json& vectors = *io::required(result, "vectors", io::array);
  for (std::size_t i = 0; i < vectors.size(); ++i)
    frames.add_line(i, [&] { read_vector(vectors[i], frames); });
  frames.end();
}

}  // namespace

ImportedFrames read_maptr(const std::filesystem::path& path, const ResultsReading& reading) {
  FrameCollector frames(reading, "maptr");
  std::size_t number = 0;
  return std::move(frames).collect(path, [&] {
    const auto take = [&](const json& result) {
      frames.add_sample("results[" + std::to_string(number++) + "]", [&] { read_sample(result, frames); });
    };
    io::for_each_json_element(path, "results", take, reading.on_step);
  });
}

}  // namespace laneloom::imports
