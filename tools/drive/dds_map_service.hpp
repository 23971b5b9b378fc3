#pragma once

#include <mutex>
#include <optional>

#include "drive/map_service.hpp"
#include "laneloom/dds/reader.hpp"
#include "laneloom/dds/writer.hpp"

namespace laneloom::drive {

/// A running laneloomd, over DDS. Throws std::runtime_error when it can't take part.
class DdsMapService : public MapService {
 public:
  explicit DdsMapService(const DdsConfig& dds);

  /// Whether the service reads the messages sent here, and its maps are read here.
  bool connected() const;
  /// Number of maps that came so far, of any state.
  std::uint64_t received() const;

  void send(const VehiclePose& pose) override { poses_.write(pose); }
  void send(const DetectionFrame& frame, std::int64_t) override { detections_.write(frame); }
  void send(const TrackedObjects& objects) override { objects_.write(objects); }
  void send(const NextTurn& turn) override;
  const LocalMap& newest(std::int64_t) override;

 private:
  void take(PublishedMap&& map);
  void lose();

  mutable std::mutex mutex_;
  LocalMap arrived_;  // guarded, as the count
  std::uint64_t received_ = 0;
  LocalMap newest_;
  dds::Participant participant_;
  dds::Writer<DetectionFrame> detections_;
  dds::Writer<VehiclePose> poses_;
  dds::Writer<TrackedObjects> objects_;
  std::optional<dds::Writer<NextTurn>> next_turns_;  ///< from the first one on
  dds::Reader<PublishedMap> maps_;                   // last: its callbacks end first
};

}  // namespace laneloom::drive
