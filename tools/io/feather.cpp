#include "io/feather.hpp"

#include <arrow_generated.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <stdexcept>
#include <type_traits>

#include "recording/compression.hpp"

namespace laneloom::io {
namespace {

static_assert(std::endian::native == std::endian::little, "as the numbers in the file are");

const recording::Bytes kMagic{'A', 'R', 'R', 'O', 'W', '1'};  // at both ends of the file
constexpr std::int64_t kMagicBytes = 6;
constexpr std::int64_t kLengthBytes = 4;          // of the footer's length, behind it
constexpr std::int64_t kPrefixBytes = 8;          // before a batch's metadata
constexpr std::int64_t kMaxRows = 1'000'000;      // more than an hour of poses; bounds the memory
constexpr std::size_t kMaxTextBytes = 1U << 26U;  // of a column in a batch: 64 for each of a million rows
constexpr std::size_t kMaxPaddingBytes = 64;      // of a column, as Arrow recommends

/// The number at the beginning of the bytes.
template <class Number>
Number number_in(const recording::Bytes& bytes) {
  Number number{};
  std::memcpy(&number, bytes.data(), sizeof(number));
  return number;
}

/// The root of metadata. Throws std::runtime_error if the metadata points outside of itself.
template <class Root>
const Root& verified(const recording::Bytes& metadata) {
  flatbuffers::Verifier verifier(metadata.data(), metadata.size());
  if (!verifier.VerifyBuffer<Root>(nullptr)) throw std::runtime_error("its metadata is damaged");
  return *flatbuffers::GetRoot<Root>(metadata.data());
}

/// Whether a list of structs is misaligned. The verifier checks the list's place, but not the alignment.
template <class List>
bool is_misaligned(const List* list) {
  return list != nullptr && reinterpret_cast<std::uintptr_t>(list->Data()) % alignof(std::int64_t) != 0;
}

template <class Cell>
bool is_of(const arrow::Field& field) {
  if constexpr (std::is_same_v<Cell, std::string>) {
    return field.type_type() == arrow::Type::Utf8;
  } else if constexpr (std::is_same_v<Cell, double>) {
    const arrow::FloatingPoint* type = field.type_as_FloatingPoint();
    return type != nullptr && type->precision() == arrow::Precision::Double;
  } else {
    const arrow::Integer* type = field.type_as_Integer();
    return type != nullptr && type->bit_width() == 64 && type->is_signed();
  }
}

template <class Cell>
constexpr const char* kCells = nullptr;
template <>
constexpr const char* kCells<std::int64_t> = "64-bit integers";
template <>
constexpr const char* kCells<double> = "64-bit floating-point numbers";
template <>
constexpr const char* kCells<std::string> = "texts";

/// The number of a column's buffers in a batch: which cells are empty, then the numbers, or the texts' ends
/// and the texts. 0: it is of a type that is not known.
std::uint32_t buffers_of(const arrow::Field& field) {
  if (field.dictionary() != nullptr) return 0;
  switch (field.type_type()) {
    case arrow::Type::Integer:
    case arrow::Type::FloatingPoint:
      return 2;
    case arrow::Type::Binary:
    case arrow::Type::Utf8:
      return 3;
    default:
      return 0;
  }
}

/// The content of a buffer, decompressed. The decompressed length comes first; it is -1 if the buffer is not
/// compressed.
recording::Bytes decompressed(const recording::Bytes& buffer, arrow::Codec codec, std::size_t expected) {
  if (buffer.size() < sizeof(std::int64_t)) throw std::runtime_error("a column is damaged");
  const auto length = number_in<std::int64_t>(buffer);
  const recording::ByteView content = recording::ByteView(buffer).subspan(sizeof(length));
  if (length == -1) return {content.begin(), content.end()};
  if (length < 0 || static_cast<std::uint64_t>(length) < expected ||
      static_cast<std::uint64_t>(length) > expected + kMaxPaddingBytes)
    throw std::runtime_error("a column is of another length than its rows");
  recording::Bytes bytes(static_cast<std::size_t>(length));
  decompress(codec == arrow::Codec::Zstd ? recording::Compression::zstd : recording::Compression::lz4,
             content, bytes);
  return bytes;
}

}  // namespace

template <class Work>
auto FeatherTable::naming_the_file(Work work) const {
  try {
    return work();
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(file_.path() + ": " + error.what());
  }
}

FeatherTable::FeatherTable(const std::filesystem::path& path) : file_(path.string()) {
  naming_the_file([this] {
    footer_ = read_footer();
    const auto& footer = verified<arrow::Footer>(footer_);
    if (footer.schema() == nullptr || footer.schema()->fields() == nullptr ||
        is_misaligned(footer.record_batches()))
      throw std::runtime_error("its footer is damaged");
    if (footer.schema()->endianness() != arrow::Endianness::Little)
      throw std::runtime_error("its numbers are big-endian");
    if (footer.record_batches() == nullptr) return;
    for (const arrow::Block* block : *footer.record_batches()) add_batch(*block);
  });
}

template <class Cell>
std::vector<Cell> FeatherTable::column(const std::string& name) const {
  return naming_the_file([&] {
    const Place place = place_of(name);
    if (!is_of<Cell>(*verified<arrow::Footer>(footer_).schema()->fields()->Get(place.column)))
      throw std::runtime_error("the column " + name + " must be of " + kCells<Cell>);
    std::vector<Cell> cells;
    cells.reserve(rows());
    for (const Batch& batch : batches_) append(batch, place, cells);
    return cells;
  });
}

/// Adds a batch. Batches must follow one another in the file, so that all together are no larger than it.
void FeatherTable::add_batch(const arrow::Block& block) {
  const std::int64_t metadata_length = block.metadata_length();
  if (block.offset() < end_of_batches_ || block.offset() > static_cast<std::int64_t>(file_.size()) ||
      metadata_length <= kPrefixBytes || block.body_length() < 0)
    throw std::runtime_error("its footer is damaged");
  Batch batch{.metadata = read(block.offset() + kPrefixBytes, metadata_length - kPrefixBytes),
              .body_offset = block.offset() + metadata_length,
              .body_length = block.body_length()};
  const arrow::RecordBatch* rows = verified<arrow::Message>(batch.metadata).header_as_RecordBatch();
  if (rows == nullptr || rows->nodes() == nullptr || rows->buffers() == nullptr || rows->length() < 0 ||
      is_misaligned(rows->nodes()) || is_misaligned(rows->buffers()))
    throw std::runtime_error("a batch of rows is damaged");
  if (rows->length() > kMaxRows - rows_) throw std::runtime_error("has more than a million rows");
  rows_ += rows->length();
  end_of_batches_ = batch.body_offset;
  batches_.push_back(std::move(batch));
}

FeatherTable::Place FeatherTable::place_of(const std::string& name) const {
  Place place;
  for (const arrow::Field* field : *verified<arrow::Footer>(footer_).schema()->fields()) {
    const std::uint32_t buffers = buffers_of(*field);
    if (buffers == 0) break;  // the places of the columns behind it are not known
    if (field->name() != nullptr && field->name()->string_view() == name) return place;
    ++place.column;
    place.buffer += buffers;
  }
  throw std::runtime_error("has no column " + name +
                           ", or one that is neither of numbers nor of texts before it");
}

/// The number of rows of a batch, which must all have a cell in the column.
std::size_t FeatherTable::full_rows(const Batch& batch, std::uint32_t column) const {
  const arrow::RecordBatch& rows = *verified<arrow::Message>(batch.metadata).header_as_RecordBatch();
  if (rows.nodes()->size() <= column || rows.nodes()->Get(column)->length() != rows.length())
    throw std::runtime_error("a batch of rows is damaged");
  if (rows.nodes()->Get(column)->null_count() != 0) throw std::runtime_error("has empty cells");
  return static_cast<std::size_t>(rows.length());
}

/// A buffer of a batch, decompressed: `expected` bytes, and padding.
recording::Bytes FeatherTable::buffer(const Batch& batch, std::uint32_t number, std::size_t expected) const {
  const arrow::RecordBatch& rows = *verified<arrow::Message>(batch.metadata).header_as_RecordBatch();
  if (rows.buffers()->size() <= number) throw std::runtime_error("a batch of rows is damaged");
  const arrow::Buffer& place = *rows.buffers()->Get(number);
  if (place.offset() < 0 || place.length() < 0 || place.offset() > batch.body_length ||
      place.length() > batch.body_length - place.offset())
    throw std::runtime_error("a batch of rows is damaged");
  if (expected == 0) return {};
  recording::Bytes bytes = read(batch.body_offset + place.offset(), place.length());
  if (rows.compression() != nullptr) bytes = decompressed(bytes, rows.compression()->codec(), expected);
  if (bytes.size() < expected) throw std::runtime_error("a column is cut off");
  return bytes;
}

template <class Number>
void FeatherTable::append(const Batch& batch, const Place& place, std::vector<Number>& to) const {
  const std::size_t rows = full_rows(batch, place.column);
  const recording::Bytes bytes = buffer(batch, place.buffer + 1, rows * sizeof(Number));
  if (rows == 0) return;
  const std::size_t before = to.size();
  to.resize(before + rows);
  std::memcpy(to.data() + before, bytes.data(), rows * sizeof(Number));
}

void FeatherTable::append(const Batch& batch, const Place& place, std::vector<std::string>& to) const {
  const std::size_t rows = full_rows(batch, place.column);
  if (rows == 0) return;
  // A text ends where the next one begins; the first number is where the first text begins.
  std::vector<std::int32_t> ends(rows + 1);
  const std::size_t ends_bytes = ends.size() * sizeof(std::int32_t);
  std::memcpy(ends.data(), buffer(batch, place.buffer + 1, ends_bytes).data(), ends_bytes);
  if (ends.front() < 0 || !std::ranges::is_sorted(ends))
    throw std::runtime_error("a column of texts is damaged");
  const auto text_bytes = static_cast<std::size_t>(ends.back());
  if (text_bytes > kMaxTextBytes) throw std::runtime_error("a column of texts is too long");
  const recording::Bytes texts = buffer(batch, place.buffer + 2, text_bytes);
  for (std::size_t row = 0; row < rows; ++row)
    to.emplace_back(texts.begin() + ends[row], texts.begin() + ends[row + 1]);
}

recording::Bytes FeatherTable::read(std::int64_t offset, std::int64_t length) const {
  const auto size = static_cast<std::int64_t>(file_.size());
  if (offset > size || length > size - offset) throw std::runtime_error("is damaged, or cut off");
  recording::Bytes bytes(static_cast<std::size_t>(length));
  file_.read(static_cast<std::uint64_t>(offset), bytes);
  return bytes;
}

recording::Bytes FeatherTable::read_footer() const {
  const auto size = static_cast<std::int64_t>(file_.size());
  if (size < kMagicBytes || read(0, kMagicBytes) != kMagic)
    throw std::runtime_error("is no Feather file (Arrow IPC)");
  const std::int64_t end = size - kMagicBytes - kLengthBytes;
  if (end < kMagicBytes || read(size - kMagicBytes, kMagicBytes) != kMagic)
    throw std::runtime_error("is cut off: its end is missing");
  const std::int64_t length = number_in<std::int32_t>(read(end, kLengthBytes));
  if (length <= 0 || length > end) throw std::runtime_error("its footer is damaged");
  return read(end - length, length);
}

template std::vector<std::int64_t> FeatherTable::column(const std::string&) const;
template std::vector<double> FeatherTable::column(const std::string&) const;
template std::vector<std::string> FeatherTable::column(const std::string&) const;

}  // namespace laneloom::io
