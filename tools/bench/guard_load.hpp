#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace laneloom::bench {

using Datagram = std::vector<std::uint8_t>;

/// The datagrams of a second of driving, as RTPS has them: 100 poses, and ten frames of `frame_bytes` each,
/// cut into datagrams of `datagram_bytes`, each of which a heartbeat follows.
std::vector<Datagram> second_of_traffic(std::size_t frame_bytes, std::size_t datagram_bytes);

}  // namespace laneloom::bench
