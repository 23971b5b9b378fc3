#include <gtest/gtest.h>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>

#include <array>
#include <chrono>
#include <memory>
#include <ostream>
#include <string>
#include <thread>

#include "DetectionsPubSubTypes.hpp"
#include "ServiceStatusPubSubTypes.hpp"
#include "VehiclePosePubSubTypes.hpp"
#include "cyclone.hpp"
#include "dds/fast_dds.hpp"
#include "end_to_end/participants.hpp"
#include "end_to_end/process.hpp"
#include "end_to_end/service.hpp"

// Perception that nobody wrote with laneloom in mind: participants of two vendors with the settings that
// these have by default, whose datagrams are as large as they like, and frames from a small one to a huge
// one.
namespace laneloom {
namespace {

namespace fast = eprosima::fastdds::dds;

constexpr std::uint32_t kPaddingPoints = 1000;
constexpr std::size_t kPaddingBytes = kPaddingPoints * 24;

msg::Point point(double x, double y) {
  msg::Point m;
  m.x(x);
  m.y(y);
  return m;
}

msg::Detection line(double y_m, double confidence, std::uint32_t points) {
  msg::Detection m;
  m.type(msg::MarkingType::LANELINE);
  m.confidence(confidence);
  for (std::uint32_t i = 0; i < points; ++i) m.points().push_back(point(-5.0 + 30.0 * i / (points - 1), y_m));
  return m;
}

/// Perception and odometry on a participant of Fast DDS as it comes, without profile or transport of ours.
class StockFastDds {
 public:
  StockFastDds(const DdsConfig& config, std::size_t frame_bytes, int period_ms)
      : padding_(frame_bytes / kPaddingBytes), period_ms_(period_ms) {
    auto* factory = fast::DomainParticipantFactory::get_instance();
    participant_ =
        factory->create_participant(static_cast<std::uint32_t>(config.domain), fast::PARTICIPANT_QOS_DEFAULT);
    fast::TypeSupport(new msg::DetectionsPubSubType).register_type(participant_);
    fast::TypeSupport(new msg::VehiclePosePubSubType).register_type(participant_);
    auto qos = fast::PUBLISHER_QOS_DEFAULT;
    qos.partition().push_back(config.vehicle_id.c_str());
    publisher_ = participant_->create_publisher(qos);
    detections_ = writer("laneloom/v3/detections", "laneloom::msg::Detections");
    poses_ = writer("laneloom/v3/vehicle_pose", "laneloom::msg::VehiclePose");
    thread_ = std::jthread([this](const std::stop_token& stopped) { run(stopped); });
  }
  ~StockFastDds() {
    thread_.request_stop();
    thread_.join();
    participant_->delete_contained_entities();
    fast::DomainParticipantFactory::get_instance()->delete_participant(participant_);
  }
  StockFastDds(const StockFastDds&) = delete;
  StockFastDds& operator=(const StockFastDds&) = delete;

 private:
  fast::DataWriter* writer(const char* topic, const char* type) {
    auto* made = participant_->create_topic(topic, type, fast::TOPIC_QOS_DEFAULT);
    auto qos = fast::DATAWRITER_QOS_DEFAULT;
    qos.endpoint().history_memory_policy = eprosima::fastdds::rtps::DYNAMIC_RESERVE_MEMORY_MODE;
    return publisher_->create_datawriter(made, qos);
  }
  void run(const std::stop_token& stopped) {
    msg::Detections frame;
    frame.source("stock");
    frame.header().session_id(5);
    frame.header().frame_id("base_link");
    frame.detections({line(-1.75, 0.9, 9), line(1.75, 0.9, 9)});
    frame.detections().resize(2 + padding_, line(12.0, 0.05, kPaddingPoints));
    msg::VehiclePose pose;
    pose.header().session_id(6);
    pose.header().frame_id("map");
    pose.pose().orientation().w(1.0);
    for (int time_ms = 0; !stopped.stop_requested(); time_ms += 10) {
      const std::int64_t stamp_ns = 1'700'000'000'000'000'000 + std::int64_t{time_ms} * 1'000'000;
      pose.header().stamp_ns(stamp_ns);
      pose.pose().position().x(0.005 * time_ms);
      poses_->write(&pose);
      if (time_ms % period_ms_ == 0 && time_ms > 0) {
        frame.header().stamp_ns(stamp_ns - 40'000'000);
        frame.header().sequence_number(frame.header().sequence_number() + 1);
        detections_->write(&frame);
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
  }

  std::size_t padding_;
  int period_ms_;
  fast::DomainParticipant* participant_ = nullptr;
  fast::Publisher* publisher_ = nullptr;
  fast::DataWriter *detections_ = nullptr, *poses_ = nullptr;
  std::jthread thread_;
};

struct Peer {
  std::string vendor, transport;
  std::size_t kilobytes;
};

std::ostream& operator<<(std::ostream& out, const Peer& peer) {
  return out << peer.vendor << ' ' << peer.transport << ' ' << peer.kilobytes << " KB";
}

std::string name_of(const testing::TestParamInfo<Peer>& info) {
  return info.param.vendor + (info.param.transport == "udp" ? "Udp" : "UdpShm") +
         std::to_string(info.param.kilobytes) + "KB";
}

class StockPeer : public testing::TestWithParam<Peer> {
 protected:
  void SetUp() override {
#ifndef CYCLONE_PARTICIPANT
    if (GetParam().vendor == "Cyclone") GTEST_SKIP() << "Cyclone DDS is missing (tools/setup)";
#endif
  }
  void perceive(const DdsConfig& config) {
    // A frame of megabytes ten times a second is more than a shared host writes beside everything else.
    const int period_ms = GetParam().kilobytes < 1000 ? 100 : 500;
    if (GetParam().vendor == "FastDds") {
      fast_dds_ = std::make_unique<StockFastDds>(config, 1000 * GetParam().kilobytes, period_ms);
      return;
    }
#ifdef CYCLONE_PARTICIPANT
    cyclone_ = start_cyclone({CYCLONE_PARTICIPANT, std::to_string(config.domain), config.vehicle_id,
                              output_.path, std::to_string(GetParam().kilobytes), std::to_string(period_ms)});
#endif
  }

  const TemporaryFile output_{"cyclone.jsonl", ""};
  std::unique_ptr<StockFastDds> fast_dds_;
  std::unique_ptr<Process> cyclone_;
};

TEST_P(StockPeer, ItsFramesAreFused) {
  const DdsConfig config = private_config("stock");
  const TemporaryFile yaml("laneloomd.yaml", "dds: {transport: " + GetParam().transport + "}\n");
  const Process service(command(config, {"--config", yaml.path}));
  Listener<ServiceStatus> status(config);
  perceive(config);
  std::uint64_t fused = 0;
  EXPECT_TRUE(status.wait_for([&](const ServiceStatus& said) {
    for (const SourceStatus& source : said.sources) fused = source.fused;
    return fused >= 10;
  })) << fused
      << " frames were fused; " << service.errors();
  EXPECT_FALSE(refused_datagrams(status.samples().back()));
  EXPECT_FALSE(status.refused_datagrams());
}

std::vector<Peer> peers() {
  std::vector<Peer> all;
  for (const char* vendor : {"FastDds", "Cyclone"})
    for (const char* transport : {"udp", "udp+shm"})
      for (const std::size_t kilobytes : {1U, 7U, 64U, 500U, 5000U})
        all.push_back({vendor, transport, kilobytes});
  return all;
}

INSTANTIATE_TEST_SUITE_P(Vendors, StockPeer, testing::ValuesIn(peers()), name_of);

/// A reader of the status, on a participant of Fast DDS as it comes, that is reached at a port of its own and
/// at an address of multicast. Nodes of ROS 2 on Cyclone DDS have such readers.
class MulticastReader {
 public:
  MulticastReader(const DdsConfig& config, std::uint32_t number) {
    auto* factory = fast::DomainParticipantFactory::get_instance();
    participant_ =
        factory->create_participant(static_cast<std::uint32_t>(config.domain), fast::PARTICIPANT_QOS_DEFAULT);
    fast::TypeSupport(new msg::ServiceStatusPubSubType).register_type(participant_);
    auto* topic = participant_->create_topic("laneloom/v3/status", "laneloom::msg::ServiceStatus",
                                             fast::TOPIC_QOS_DEFAULT);
    auto in_vehicle = fast::SUBSCRIBER_QOS_DEFAULT;
    in_vehicle.partition().push_back(config.vehicle_id.c_str());
    auto qos = fast::DATAREADER_QOS_DEFAULT;
    qos.reliability().kind = fast::RELIABLE_RELIABILITY_QOS;
    qos.endpoint().history_memory_policy = eprosima::fastdds::rtps::DYNAMIC_RESERVE_MEMORY_MODE;
    // Behind the ports that participants of the domain take.
    const std::uint32_t free_port = 7400 + 250 * static_cast<std::uint32_t>(config.domain) + 240;
    qos.endpoint().unicast_locator_list.push_back(address({127, 0, 0, 1}, free_port + number));
    qos.endpoint().multicast_locator_list.push_back(address({239, 255, 0, 1}, free_port));
    reader_ = participant_->create_subscriber(in_vehicle)->create_datareader(topic, qos);
  }
  ~MulticastReader() {
    participant_->delete_contained_entities();
    fast::DomainParticipantFactory::get_instance()->delete_participant(participant_);
  }
  MulticastReader(const MulticastReader&) = delete;
  MulticastReader& operator=(const MulticastReader&) = delete;

  bool hears_the_service() { return reader_->wait_for_unread_message({30, 0}); }

 private:
  static eprosima::fastdds::rtps::Locator_t address(const std::array<unsigned char, 4>& ip,
                                                    std::uint32_t port) {
    eprosima::fastdds::rtps::Locator_t locator(LOCATOR_KIND_UDPv4, port);
    eprosima::fastdds::rtps::IPLocator::setIPv4(locator, ip[0], ip[1], ip[2], ip[3]);
    return locator;
  }

  fast::DomainParticipant* participant_ = nullptr;
  fast::DataReader* reader_ = nullptr;
};

TEST(ReadersWithOneAddressOfMulticast, DoNotEndTheService) {
  const DdsConfig config = private_config("multicast");
  const Process service(command(config));
  MulticastReader first(config, 1), second(config, 2);
  EXPECT_TRUE(first.hears_the_service()) << service.errors();
  EXPECT_TRUE(second.hears_the_service()) << service.errors();
}

}  // namespace
}  // namespace laneloom
