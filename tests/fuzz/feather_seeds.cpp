#include <fstream>
#include <string>

#include "io/feather_writer.hpp"

/// Writes a table of tracks per compression into the folder that is given.
int main(int /*argc*/, char** argv) {
  using laneloom::recording::Compression;
  for (const auto compression : {Compression::none, Compression::lz4, Compression::zstd}) {
    auto columns = laneloom::pose_columns(1, 5);
    columns.insert(columns.begin() + 1, {"track_uuid", std::vector<std::string>{"a", "bc", "", "d", "a"}});
    const auto bytes = laneloom::FeatherWriter(columns, compression).write(3);
    std::ofstream out(std::string(argv[1]) + "/" + std::to_string(static_cast<int>(compression)) +
                      ".feather");
    out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  }
}
