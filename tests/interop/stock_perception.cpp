// stock_perception DOMAIN VEHICLE_ID FILE: a perception on Fast DDS with the settings that it has by default.
// It looks for stop lines, sees none, and pads its frames to 24 KB. Frames have the stamps of poses. Into
// FILE go "session_id,sequence,published_ns" of each, until it is told to end.
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <random>
#include <string>
#include <thread>

#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>

#include "DetectionsPubSubTypes.hpp"
#include "VehiclePosePubSubTypes.hpp"
#include "dds/fast_dds.hpp"

namespace {

namespace fast = eprosima::fastdds::dds;
namespace msg = laneloom::msg;

constexpr std::int64_t kPeriod_ns = 100'000'000;
constexpr std::size_t kPaddingPoints = 1000;

volatile std::sig_atomic_t told_to_end = 0;

msg::Detections empty_frame() {
  msg::Detection padding;  // of a line that nobody trusts
  padding.type(msg::MarkingType::LANELINE);
  padding.confidence(0.05);
  padding.points().resize(kPaddingPoints);
  for (std::size_t i = 0; i < kPaddingPoints; ++i) padding.points()[i].x(0.01 * static_cast<double>(i));
  msg::Detections frame;
  frame.source("stock_perception");
  frame.header().session_id(std::uint64_t{std::random_device()()} << 32U | 1U);
  frame.header().frame_id("base_link");
  frame.detected_types().push_back(msg::MarkingType::STOPLINE);
  frame.detections({padding});
  return frame;
}

/// The stamp of the newest pose that has come; none: `before`.
std::int64_t newest_stamp_ns(fast::DataReader& poses, std::int64_t before) {
  msg::VehiclePose pose;
  fast::SampleInfo info;
  while (poses.take_next_sample(&pose, &info) == fast::RETCODE_OK)
    if (info.valid_data) before = pose.header().stamp_ns();
  return before;
}

void perceive(fast::DataReader& poses, fast::DataWriter& detections, std::ostream& log) {
  msg::Detections frame = empty_frame();
  auto& header = frame.header();
  log << "session_id,sequence,published_ns" << std::endl;
  while (told_to_end == 0) {
    const std::int64_t stamp_ns = newest_stamp_ns(poses, header.stamp_ns());
    if (stamp_ns >= header.stamp_ns() + kPeriod_ns) {
      header.stamp_ns(stamp_ns);
      header.sequence_number(header.sequence_number() + 1);
      const std::chrono::nanoseconds now = std::chrono::system_clock::now().time_since_epoch();
      log << header.session_id() << ',' << header.sequence_number() << ',' << now.count() << std::endl;
      detections.write(&frame);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) return EXIT_FAILURE;
  std::signal(SIGTERM, [](int) { told_to_end = 1; });
  auto* factory = fast::DomainParticipantFactory::get_instance();
  auto* participant = factory->create_participant(static_cast<std::uint32_t>(std::stoul(argv[1])),
                                                  fast::PARTICIPANT_QOS_DEFAULT);
  auto publisher_qos = fast::PUBLISHER_QOS_DEFAULT;
  publisher_qos.partition().push_back(argv[2]);
  auto subscriber_qos = fast::SUBSCRIBER_QOS_DEFAULT;
  subscriber_qos.partition().push_back(argv[2]);
  fast::TypeSupport(new msg::DetectionsPubSubType).register_type(participant);
  fast::TypeSupport(new msg::VehiclePosePubSubType).register_type(participant);
  auto* detections = participant->create_topic("laneloom/v3/detections", "laneloom::msg::Detections",
                                               fast::TOPIC_QOS_DEFAULT);
  auto* poses = participant->create_topic("laneloom/v3/vehicle_pose", "laneloom::msg::VehiclePose",
                                          fast::TOPIC_QOS_DEFAULT);
  auto writer_qos = fast::DATAWRITER_QOS_DEFAULT;
  writer_qos.endpoint().history_memory_policy = eprosima::fastdds::rtps::DYNAMIC_RESERVE_MEMORY_MODE;
  auto* writer = participant->create_publisher(publisher_qos)->create_datawriter(detections, writer_qos);
  auto* reader =
      participant->create_subscriber(subscriber_qos)->create_datareader(poses, fast::DATAREADER_QOS_DEFAULT);
  std::ofstream log(argv[3]);
  perceive(*reader, *writer, log);
  participant->delete_contained_entities();
  factory->delete_participant(participant);
}
