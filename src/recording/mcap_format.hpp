#pragma once

#include <array>
#include <map>
#include <memory>
#include <string>

#include "recording/bytes.hpp"

/// The MCAP container, version 0 (mcap.dev/spec), as far as a reader and a writer share it.
///
/// A file is: magic, Header, data section, DataEnd, summary section, summary offsets, Footer, magic. Each
/// record is an opcode, the length of its content, and the content.
namespace laneloom::recording {

inline constexpr std::array<std::uint8_t, 8> kMcapMagic{0x89, 'M', 'C', 'A', 'P', '0', '\r', '\n'};

enum class McapOpcode : std::uint8_t {
  header = 0x01,
  footer = 0x02,
  schema = 0x03,
  channel = 0x04,
  message = 0x05,
  chunk = 0x06,
  message_index = 0x07,
  chunk_index = 0x08,
  statistics = 0x0B,
  metadata = 0x0C,
  metadata_index = 0x0D,
  summary_offset = 0x0E,
  data_end = 0x0F
};

/// Opcode and length, before a record's content.
inline constexpr std::size_t kMcapRecordHeaderBytes = 9;
inline constexpr std::size_t kMcapFooterBytes = 20;
/// Size of the part of a message record before the message itself.
inline constexpr std::size_t kMcapMessageHeaderBytes = 22;

/// What a file says of itself: texts by their keys.
using McapMetadata = std::map<std::string, std::string>;

/// The definition of a message type.
struct McapSchema {
  std::string name;      ///< of the message type
  std::string encoding;  ///< of `data`, such as "omgidl"
  std::string data;      ///< the definition of the type
  bool operator==(const McapSchema&) const = default;
};

/// A stream of messages of one topic.
struct McapChannel {
  std::string topic;
  std::string message_encoding;                   ///< such as "cdr"
  std::shared_ptr<const McapSchema> schema = {};  ///< null: the channel has none
  bool operator==(const McapChannel&) const = default;
};

}  // namespace laneloom::recording
