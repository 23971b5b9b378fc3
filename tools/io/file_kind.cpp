#include "io/file_kind.hpp"

#include <array>
#include <fstream>
#include <string_view>

namespace laneloom::io {
namespace {

using std::string_view_literals::operator""sv;

struct Kind {
  std::string_view begin;
  std::string_view text;
};

constexpr std::array kKinds{
    Kind{"\x28\xb5\x2f\xfd"sv, "is compressed with zstd"},
    Kind{"\x1f\x8b"sv, "is compressed with gzip"},
    Kind{"BZh"sv, "is compressed with bzip2"},
    Kind{"\xfd"
         "7zXZ"sv,
         "is compressed with xz"},
    Kind{"\x04\x22\x4d\x18"sv, "is compressed with lz4"},
    Kind{"PK\x03\x04"sv, "is a ZIP archive"},
    Kind{"\x89MCAP0\r\n"sv, "is a recording (MCAP)"},
    Kind{"SQLite format 3"sv, "is a database of SQLite, as rosbag2 writes it (.db3)"},
    Kind{"#ROSBAG"sv, "is a bag of ROS 1"},
    Kind{"ARROW1"sv, "is a Feather file"},
    Kind{"PAR1"sv, "is a Parquet file"},
    Kind{"\x89HDF"sv, "is an HDF5 file"},
    Kind{"\x93NUMPY"sv, "is an array of NumPy"},
    Kind{"\x80\x02"sv, "is a pickle of Python"},
    Kind{"\x80\x03"sv, "is a pickle of Python"},
    Kind{"\x80\x04"sv, "is a pickle of Python"},
    Kind{"\x80\x05"sv, "is a pickle of Python"},
    Kind{"version https://git-lfs"sv, "is a pointer of Git LFS, not the file itself"},
    Kind{"<?xml"sv, kXml},
    Kind{"<osm"sv, kXml},
    Kind{"\xff\xfe"sv, kUtf16},
    Kind{"\xfe\xff"sv, kUtf16},
    Kind{"<!DOCTYPE"sv, "is a web page"},
    Kind{"<html"sv, "is a web page"},
    Kind{"\x7f"
         "ELF"sv,
         "is a program"},
    Kind{"\x89PNG"sv, "is a picture"},
    Kind{"\xff\xd8\xff"sv, "is a picture"},
};

}  // namespace

std::string file_kind(const std::filesystem::path& path) {
  std::error_code unknown;
  if (std::filesystem::is_directory(path, unknown)) return "is a directory";
  if (!std::filesystem::is_regular_file(path, unknown)) return "";
  std::array<char, 32> bytes{};
  std::ifstream in(path, std::ios::binary);
  if (!in) return "";
  in.read(bytes.data(), bytes.size());
  const std::string_view begin(bytes.data(), static_cast<std::size_t>(in.gcount()));
  if (begin.empty()) return std::string(kEmpty);
  for (const Kind& kind : kKinds)
    if (begin.starts_with(kind.begin)) return std::string(kind.text);
  const bool binary = begin.find('\0') != std::string_view::npos;
  return binary ? "is binary, and of no kind that laneloom knows" : "";
}

}  // namespace laneloom::io
