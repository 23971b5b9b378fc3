#pragma once

#include <array>
#include <cstdint>

#include "laneloom/config.hpp"
#include "laneloom/messages.hpp"
#include "laneloom/types.hpp"

/// The most expensive frames that the bounds of the IDL allow.
namespace laneloom::bench {

enum class WorstKind : std::uint8_t {
  parallel,    ///< lines side by side, over the whole range
  crossing,    ///< a grid of lines across one another
  spiralling,  ///< spirals one in the other
  closed,      ///< rings round many centres
  doubled,     ///< pairs of lines that nearly coincide
  heap,        ///< all lines in one spot, of every type
  changing     ///< lines in other places in every frame
};
inline constexpr std::array kWorstKinds{WorstKind::parallel, WorstKind::crossing, WorstKind::spiralling,
                                        WorstKind::closed,   WorstKind::doubled,  WorstKind::heap,
                                        WorstKind::changing};
const char* name(WorstKind kind);

/// Frame `number` of a kind: as many detections as a message may have, in the body frame, all equally
/// trusted.
DetectionFrame worst_frame(WorstKind kind, std::uint64_t number);

/// The times in milliseconds that a session takes for a frame of this kind, admission included. They are
/// measured over `frames` frames, ten per second, at 10 m/s.
TimeSummary time_worst(const Config& config, WorstKind kind, std::uint64_t frames);

}  // namespace laneloom::bench
