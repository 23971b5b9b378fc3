#include "recording/mcap_catalogue.hpp"

#include <stdexcept>

namespace laneloom::recording {

void McapCatalogue::count(std::size_t bytes) {
  bytes_ += bytes;
  if (bytes_ > max_bytes_) throw std::runtime_error("schemas and channels are too large");
}

void McapCatalogue::add_schema(ByteView record) {
  ByteReader reader(record);
  const auto id = reader.number<std::uint16_t>();
  if (id == 0) return;  // "invalid and should be ignored by readers"
  McapSchema schema;
  schema.name = reader.text();
  schema.encoding = reader.text();
  schema.data = reader.text();
  auto& known = schemas_[id];
  if (known && *known != schema)
    throw std::runtime_error("schema " + std::to_string(id) + " is described in two ways");
  if (known) return;
  count(record.size());
  known = std::make_shared<McapSchema>(std::move(schema));
}

void McapCatalogue::add_channel(ByteView record) {
  ByteReader reader(record);
  const auto id = reader.number<std::uint16_t>();
  const auto schema_id = reader.number<std::uint16_t>();
  McapChannel channel;
  channel.topic = reader.text();
  channel.message_encoding = reader.text();
  if (schema_id != 0) {
    const auto schema = schemas_.find(schema_id);
    if (schema == schemas_.end())
      throw std::runtime_error("channel " + std::to_string(id) + " has a schema that is not there");
    channel.schema = schema->second;
  }
  const auto [known, added] = channels_.try_emplace(id, channel);
  if (added) return count(record.size());
  if (known->second != channel)
    throw std::runtime_error("channel " + std::to_string(id) + " is described in two ways");
}

const McapChannel& McapCatalogue::channel(std::uint16_t id) const {
  const auto found = channels_.find(id);
  if (found == channels_.end())
    throw std::runtime_error("channel " + std::to_string(id) + " is not described");
  return found->second;
}

}  // namespace laneloom::recording
