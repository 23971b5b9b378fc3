#pragma once

#include <arrow_generated.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "recording/compression.hpp"

namespace laneloom {

/// Writes Arrow's IPC file format as pandas does for a data set, from the format's description alone.
class FeatherWriter {
 public:
  using Texts = std::vector<std::string>;
  using Cells = std::variant<std::vector<std::int64_t>, std::vector<double>, Texts>;
  using Columns = std::vector<std::pair<std::string, Cells>>;

  explicit FeatherWriter(Columns columns, recording::Compression compression = recording::Compression::lz4)
      : columns_(std::move(columns)), compression_(compression) {}

  /// The rows in batches of at most so many.
  recording::Bytes write(std::size_t rows_per_batch = 1'000'000) {
    file_ = {'A', 'R', 'R', 'O', 'W', '1', 0, 0};
    for (std::size_t row = 0; row < rows(); row += rows_per_batch)
      write_batch(row, std::min(rows_per_batch, rows() - row));
    const recording::Bytes footer = make_footer();
    append(footer);
    append_number(static_cast<std::int32_t>(footer.size()));
    append({'A', 'R', 'R', 'O', 'W', '1'});
    return file_;
  }

 private:
  std::size_t rows() const {
    return std::visit([](const auto& cells) { return cells.size(); }, columns_.front().second);
  }
  void append(const recording::Bytes& bytes) { file_.insert(file_.end(), bytes.begin(), bytes.end()); }
  void append_number(std::int32_t number) {
    recording::Bytes bytes(sizeof(number));
    std::memcpy(bytes.data(), &number, sizeof(number));
    append(bytes);
  }
  static void pad(recording::Bytes& bytes) { bytes.resize((bytes.size() + 7) / 8 * 8); }

  /// The buffers of a column behind the one that tells which cells are empty.
  static std::vector<recording::Bytes> contents(const Cells& column, std::size_t first, std::size_t count) {
    if (const auto* texts = std::get_if<Texts>(&column)) {
      std::vector<std::int32_t> ends{0};
      std::string all;
      for (std::size_t row = first; row < first + count; ++row) {
        all += (*texts)[row];
        ends.push_back(static_cast<std::int32_t>(all.size()));
      }
      return {bytes_of(ends.data(), ends.size() * sizeof(std::int32_t)), bytes_of(all.data(), all.size())};
    }
    if (const auto* numbers = std::get_if<std::vector<double>>(&column))
      return {bytes_of(numbers->data() + first, count * sizeof(double))};
    const auto& numbers = std::get<std::vector<std::int64_t>>(column);
    return {bytes_of(numbers.data() + first, count * sizeof(std::int64_t))};
  }
  static recording::Bytes bytes_of(const void* data, std::size_t size) {
    recording::Bytes bytes(size);
    if (size > 0) std::memcpy(bytes.data(), data, size);
    return bytes;
  }

  recording::Bytes buffer_of(const recording::Bytes& plain) const {
    if (compression_ == recording::Compression::none || plain.empty()) return plain;
    recording::Bytes buffer(8);
    const auto size = static_cast<std::int64_t>(plain.size());
    std::memcpy(buffer.data(), &size, 8);
    compress(compression_, plain, buffer);
    return buffer;
  }

  void write_batch(std::size_t first, std::size_t count) {
    recording::Bytes body;
    std::vector<arrow::FieldNode> nodes;
    std::vector<arrow::Buffer> buffers;
    for (const auto& [name, cells] : columns_) {
      nodes.emplace_back(static_cast<std::int64_t>(count), 0);
      buffers.emplace_back(static_cast<std::int64_t>(body.size()), 0);  // no cell is empty
      for (const recording::Bytes& plain : contents(cells, first, count)) {
        const recording::Bytes buffer = buffer_of(plain);
        buffers.emplace_back(static_cast<std::int64_t>(body.size()),
                             static_cast<std::int64_t>(buffer.size()));
        body.insert(body.end(), buffer.begin(), buffer.end());
        pad(body);
      }
    }
    flatbuffers::FlatBufferBuilder builder;
    const auto codec =
        compression_ == recording::Compression::zstd ? arrow::Codec::Zstd : arrow::Codec::Lz4Frame;
    const auto compressed = compression_ == recording::Compression::none
                                ? flatbuffers::Offset<arrow::BodyCompression>()
                                : arrow::CreateBodyCompression(builder, codec);
    const auto batch = arrow::CreateRecordBatch(builder, static_cast<std::int64_t>(count),
                                                builder.CreateVectorOfStructs(nodes),
                                                builder.CreateVectorOfStructs(buffers), compressed);
    builder.Finish(arrow::CreateMessage(builder, arrow::MessageHeader::RecordBatch, batch.Union(),
                                        static_cast<std::int64_t>(body.size())));
    recording::Bytes metadata(builder.GetBufferPointer(), builder.GetBufferPointer() + builder.GetSize());
    pad(metadata);
    blocks_.emplace_back(static_cast<std::int64_t>(file_.size()),
                         static_cast<std::int32_t>(metadata.size() + 8),
                         static_cast<std::int64_t>(body.size()));
    append_number(-1);
    append_number(static_cast<std::int32_t>(metadata.size()));
    append(metadata);
    append(body);
  }

  static std::pair<arrow::Type, flatbuffers::Offset<void>> type_of(const Cells& cells,
                                                                   flatbuffers::FlatBufferBuilder& builder) {
    if (std::holds_alternative<Texts>(cells)) return {arrow::Type::Utf8, arrow::CreateUtf8(builder).Union()};
    if (std::holds_alternative<std::vector<double>>(cells))
      return {arrow::Type::FloatingPoint,
              arrow::CreateFloatingPoint(builder, arrow::Precision::Double).Union()};
    return {arrow::Type::Integer, arrow::CreateInteger(builder, 64, true).Union()};
  }

  recording::Bytes make_footer() const {
    flatbuffers::FlatBufferBuilder builder;
    std::vector<flatbuffers::Offset<arrow::Field>> fields;
    for (const auto& [name, cells] : columns_) {
      const auto text = builder.CreateString(name);
      const auto [type, of] = type_of(cells, builder);
      fields.push_back(arrow::CreateField(builder, text, type, of));
    }
    const auto schema = arrow::CreateSchema(builder, arrow::Endianness::Little, builder.CreateVector(fields));
    builder.Finish(arrow::CreateFooter(builder, schema, builder.CreateVectorOfStructs(blocks_)));
    return {builder.GetBufferPointer(), builder.GetBufferPointer() + builder.GetSize()};
  }

  Columns columns_;
  recording::Compression compression_;
  recording::Bytes file_;
  std::vector<arrow::Block> blocks_;
};

/// A row of the annotations of Argoverse 2: a box of 4 x 2 x 1.5 m, at a place of the body frame.
struct AnnotationRow {
  std::int64_t stamp_ns = 0;
  std::string track, category;
  double x = 0.0, y = 0.0;
  double yaw_rad = 0.0;
  double length_m = 4.0;
};

/// Annotations as Argoverse 2 has them.
inline FeatherWriter::Columns annotation_columns(const std::vector<AnnotationRow>& rows) {
  std::vector<std::int64_t> stamps_ns, points;
  FeatherWriter::Texts tracks, categories;
  std::vector<double> lengths, x, y, qw, qz;
  for (const AnnotationRow& row : rows) {
    stamps_ns.push_back(row.stamp_ns);
    points.push_back(9);
    tracks.push_back(row.track);
    categories.push_back(row.category);
    lengths.push_back(row.length_m);
    x.push_back(row.x);
    y.push_back(row.y);
    qw.push_back(std::cos(row.yaw_rad / 2.0));
    qz.push_back(std::sin(row.yaw_rad / 2.0));
  }
  const auto all = [&](double value) { return std::vector<double>(rows.size(), value); };
  return {{"timestamp_ns", stamps_ns},
          {"track_uuid", tracks},
          {"category", categories},
          {"length_m", lengths},
          {"width_m", all(2.0)},
          {"height_m", all(1.5)},
          {"qw", qw},
          {"qx", all(0.0)},
          {"qy", all(0.0)},
          {"qz", qz},
          {"tx_m", x},
          {"ty_m", y},
          {"tz_m", all(0.75)},
          {"num_interior_pts", points}};
}

/// Poses 100 ms apart along x, as Argoverse 2 has them.
inline FeatherWriter::Columns pose_columns(std::int64_t first_ns, std::size_t count) {
  std::vector<std::int64_t> stamps_ns;
  std::vector<double> x;
  for (std::size_t i = 0; i < count; ++i) {
    stamps_ns.push_back(first_ns + static_cast<std::int64_t>(i) * 100'000'000);
    x.push_back(static_cast<double>(i));
  }
  const std::vector<double> zeros(count, 0.0), ones(count, 1.0);
  return {{"timestamp_ns", stamps_ns},
          {"qw", ones},
          {"qx", zeros},
          {"qy", zeros},
          {"qz", zeros},
          {"tx_m", x},
          {"ty_m", zeros},
          {"tz_m", zeros}};
}

}  // namespace laneloom
