#include "io/feather.hpp"

#include <arrow_generated.h>

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
constexpr std::int64_t kLengthBytes = 4;      // of the footer's length, behind it
constexpr std::int64_t kPrefixBytes = 8;      // before a batch's metadata
constexpr std::int64_t kMaxRows = 1'000'000;  // more than an hour of poses; bounds the memory
constexpr std::size_t kMaxPaddingBytes = 64;  // of a column, as Arrow recommends

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

template <class Number>
bool is_of(const arrow::Field& field) {
  if constexpr (std::is_same_v<Number, double>) {
    const arrow::FloatingPoint* type = field.type_as_FloatingPoint();
    return type != nullptr && type->precision() == arrow::Precision::Double;
  } else {
    const arrow::Integer* type = field.type_as_Integer();
    return type != nullptr && type->bit_width() == 64 && type->is_signed();
  }
}

/// Whether a column is of numbers. Such a column has two buffers: which cells are empty, and the numbers.
bool is_of_numbers(const arrow::Field& field) {
  return field.type_type() == arrow::Type::Integer || field.type_type() == arrow::Type::FloatingPoint;
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

template <class Number>
std::vector<Number> FeatherTable::column(const std::string& name) const {
  return naming_the_file([&] {
    const std::uint32_t column = index_of(name);
    if (!is_of<Number>(*verified<arrow::Footer>(footer_).schema()->fields()->Get(column)))
      throw std::runtime_error("the column " + name + " must be of 64-bit " +
                               (std::is_same_v<Number, double> ? "floating-point numbers" : "integers"));
    std::vector<Number> numbers;
    numbers.reserve(rows());
    for (const Batch& batch : batches_) append(batch, column, numbers);
    return numbers;
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

std::uint32_t FeatherTable::index_of(const std::string& name) const {
  const auto& fields = *verified<arrow::Footer>(footer_).schema()->fields();
  for (std::uint32_t i = 0; i < fields.size(); ++i) {
    if (!is_of_numbers(*fields.Get(i))) break;  // the number of its buffers is not known
    if (fields.Get(i)->name() != nullptr && fields.Get(i)->name()->string_view() == name) return i;
  }
  throw std::runtime_error("has no column " + name + ", or one that is not of numbers before it");
}

template <class Number>
void FeatherTable::append(const Batch& batch, std::uint32_t column, std::vector<Number>& to) const {
  const arrow::RecordBatch& rows = *verified<arrow::Message>(batch.metadata).header_as_RecordBatch();
  const std::uint32_t numbers = 2 * column + 1;
  if (rows.nodes()->size() <= column || rows.buffers()->size() <= numbers ||
      rows.nodes()->Get(column)->length() != rows.length())
    throw std::runtime_error("a batch of rows is damaged");
  if (rows.nodes()->Get(column)->null_count() != 0) throw std::runtime_error("has empty cells");
  if (rows.length() == 0) return;
  const arrow::Buffer& buffer = *rows.buffers()->Get(numbers);
  if (buffer.offset() < 0 || buffer.length() < 0 || buffer.offset() > batch.body_length ||
      buffer.length() > batch.body_length - buffer.offset())
    throw std::runtime_error("a batch of rows is damaged");
  recording::Bytes bytes = read(batch.body_offset + buffer.offset(), buffer.length());
  const std::size_t expected = static_cast<std::size_t>(rows.length()) * sizeof(Number);
  if (rows.compression() != nullptr) bytes = decompressed(bytes, rows.compression()->codec(), expected);
  if (bytes.size() < expected) throw std::runtime_error("a column is cut off");
  const std::size_t before = to.size();
  to.resize(before + static_cast<std::size_t>(rows.length()));
  std::memcpy(to.data() + before, bytes.data(), expected);
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

}  // namespace laneloom::io
