#pragma once

#include <arrow_generated.h>

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
  using Numbers = std::variant<std::vector<std::int64_t>, std::vector<double>>;
  using Columns = std::vector<std::pair<std::string, Numbers>>;

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
    return std::visit([](const auto& numbers) { return numbers.size(); }, columns_.front().second);
  }
  void append(const recording::Bytes& bytes) { file_.insert(file_.end(), bytes.begin(), bytes.end()); }
  void append_number(std::int32_t number) {
    recording::Bytes bytes(sizeof(number));
    std::memcpy(bytes.data(), &number, sizeof(number));
    append(bytes);
  }
  static void pad(recording::Bytes& bytes) { bytes.resize((bytes.size() + 7) / 8 * 8); }

  recording::Bytes buffer_of(const Numbers& column, std::size_t first, std::size_t count) const {
    recording::Bytes plain(count * 8);
    std::visit([&](const auto& numbers) { std::memcpy(plain.data(), numbers.data() + first, plain.size()); },
               column);
    if (compression_ == recording::Compression::none) return plain;
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
    for (const auto& [name, numbers] : columns_) {
      const recording::Bytes buffer = buffer_of(numbers, first, count);
      nodes.emplace_back(static_cast<std::int64_t>(count), 0);
      buffers.emplace_back(static_cast<std::int64_t>(body.size()), 0);  // no cell is empty
      buffers.emplace_back(static_cast<std::int64_t>(body.size()), static_cast<std::int64_t>(buffer.size()));
      body.insert(body.end(), buffer.begin(), buffer.end());
      pad(body);
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

  recording::Bytes make_footer() const {
    flatbuffers::FlatBufferBuilder builder;
    std::vector<flatbuffers::Offset<arrow::Field>> fields;
    for (const auto& [name, numbers] : columns_) {
      const bool whole = std::holds_alternative<std::vector<std::int64_t>>(numbers);
      const auto text = builder.CreateString(name);
      fields.push_back(
          whole ? arrow::CreateField(builder, text, arrow::Type::Integer,
                                     arrow::CreateInteger(builder, 64, true).Union())
                : arrow::CreateField(builder, text, arrow::Type::FloatingPoint,
                                     arrow::CreateFloatingPoint(builder, arrow::Precision::Double).Union()));
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
