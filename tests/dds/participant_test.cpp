#include "laneloom/dds/participant.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <condition_variable>
#include <fstream>
#include <functional>
#include <mutex>

#include "dds/participant_impl.hpp"
#include "dds/topic_traits.hpp"
#include "end_to_end/eavesdropper.hpp"
#include "laneloom/dds/discovery.hpp"
#include "laneloom/dds/raw_reader.hpp"
#include "laneloom/dds/raw_writer.hpp"
#include "laneloom/dds/reader.hpp"
#include "laneloom/dds/writer.hpp"
#include "own_domain.hpp"
#include "temporary_folder.hpp"

namespace laneloom::dds {
namespace {

using namespace std::chrono_literals;

/// The messages that came, for a test to wait for. Thread-safe.
template <class T>
class Received {
 public:
  ReaderCallbacks<T> callbacks() {
    ReaderCallbacks<T> result;
    result.sample = [this](T&& sample) {
      const std::lock_guard lock(mutex_);
      samples_.push_back(std::move(sample));
      changed_.notify_all();
    };
    result.refused = [this](std::string_view reason) {
      const std::lock_guard lock(mutex_);
      refused_.emplace_back(reason);
      changed_.notify_all();
    };
    result.alive = [this](int writers) {
      const std::lock_guard lock(mutex_);
      alive_ = writers;
      changed_.notify_all();
    };
    result.deadline_missed = [this](std::uint64_t total) {
      const std::lock_guard lock(mutex_);
      deadlines_missed_ = total;
      changed_.notify_all();
    };
    return result;
  }
  bool wait_for_samples(std::size_t count) {
    return wait([&] { return samples_.size() >= count; });
  }
  bool wait_for_refusals(std::size_t count) {
    return wait([&] { return refused_.size() >= count; });
  }
  bool wait_for_alive(int writers) {
    return wait([&] { return alive_ == writers; });
  }
  bool wait_for_missed_deadline() {
    return wait([&] { return deadlines_missed_ > 0; });
  }
  std::vector<T> samples() {
    const std::lock_guard lock(mutex_);
    return samples_;
  }
  std::vector<std::string> refused() {
    const std::lock_guard lock(mutex_);
    return refused_;
  }

 private:
  template <class Condition>
  bool wait(Condition condition) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, 20s, condition);
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<T> samples_;
  std::vector<std::string> refused_;
  int alive_ = 0;
  std::uint64_t deadlines_missed_ = 0;
};

DdsConfig config_of(const std::string& vehicle) {
  DdsConfig config;
  config.domain = own_domain();
  config.vehicle_id = vehicle + std::to_string(getpid());
  return config;
}

template <class Endpoint>
bool matched(const Endpoint& endpoint, int count = 1) {
  for (int i = 0; i < 2000 && endpoint.matched() < count; ++i) usleep(10'000);
  return endpoint.matched() >= count;
}

DetectionFrame frame_of(std::uint64_t sequence) {
  DetectionFrame frame;
  frame.sequence = sequence;
  frame.detections.push_back(Detection{.confidence = 0.5, .points = {{0, 0, 0}, {1, 2, 3}}});
  return frame;
}

PublishedMap map_of(std::uint64_t sequence) {
  PublishedMap map;
  map.sequence = sequence;
  map.frame_id = "map";
  map.map.boundaries.push_back(Marking{.id = 7, .points = {{0, 0, 0}, {1, 2, 3}}});
  return map;
}

/// Fast DDS by itself announces a participant before it listens. Who answers that at once would not be heard.
bool listens_before_it_is_announced() {
  Eavesdropper eavesdropper(own_domain());
  DdsConfig config;
  config.domain = own_domain();
  const Participant participant(config, "newcomer");
  return eavesdropper.participants().empty();
}

TEST(Participants, ListenBeforeTheyAreAnnounced) {
  // A busy host may stop the test until the announcement has come.
  EXPECT_TRUE(listens_before_it_is_announced() || listens_before_it_is_announced() ||
              listens_before_it_is_announced());
}

TEST(Participants, FramesArriveInOrderAndWhole) {
  Received<DetectionFrame> received;
  const Participant there(config_of("order"), "there"), here(config_of("order"), "here");
  const Reader<DetectionFrame> reader(there, received.callbacks());
  Writer<DetectionFrame> writer(here);
  ASSERT_TRUE(matched(writer) && matched(reader));
  for (std::uint64_t i = 0; i < 50; ++i) {
    ASSERT_TRUE(writer.write(frame_of(i)));
    usleep(2'000);
  }
  ASSERT_TRUE(received.wait_for_samples(50));
  const auto samples = received.samples();
  for (std::size_t i = 0; i < 50; ++i) EXPECT_EQ(samples[i].sequence, i);
  EXPECT_EQ(samples[0].detections[0].points, (Polyline{{0, 0, 0}, {1, 2, 3}}));
}

TEST(Participants, ALargeMapArrives) {
  Received<PublishedMap> received;
  const Participant there(config_of("large"), "there"), here(config_of("large"), "here");
  const Reader<PublishedMap> reader(there, received.callbacks());
  Writer<PublishedMap> writer(here);
  ASSERT_TRUE(matched(writer));
  auto map = map_of(1);
  map.map.boundaries.assign(40, Marking{.id = 1, .points = Polyline(1024, Point(1, 2, 3))});  // 1 MB
  ASSERT_TRUE(writer.write(map));
  ASSERT_TRUE(received.wait_for_samples(1));
  EXPECT_EQ(received.samples()[0].map.boundaries.size(), 40U);
}

TEST(Participants, ALateJoinerGetsTheNewestMap) {
  const Participant here(config_of("late"), "here");
  Writer<PublishedMap> writer(here);
  ASSERT_TRUE(writer.write(map_of(1)) && writer.write(map_of(2)));
  Received<PublishedMap> received;
  const Participant there(config_of("late"), "there");
  const Reader<PublishedMap> reader(there, received.callbacks());
  ASSERT_TRUE(received.wait_for_samples(1));
  EXPECT_EQ(received.samples()[0].sequence, 2U);
}

TEST(Participants, PartitionsDoNotMix) {
  Received<PublishedMap> own, foreign;
  const Participant a(config_of("a"), "a"), b(config_of("b"), "b");
  Writer<PublishedMap> writer_a(a), writer_b(b);
  const Participant reading_a(config_of("a"), "reading a"), reading_b(config_of("b"), "reading b");
  const Reader<PublishedMap> reader_a(reading_a, own.callbacks()), reader_b(reading_b, foreign.callbacks());
  ASSERT_TRUE(matched(writer_a) && matched(writer_b));
  ASSERT_TRUE(writer_a.write(map_of(1)) && writer_b.write(map_of(2)));
  ASSERT_TRUE(own.wait_for_samples(1) && foreign.wait_for_samples(1));
  EXPECT_EQ(own.samples()[0].sequence, 1U);
  EXPECT_EQ(foreign.samples()[0].sequence, 2U);
  EXPECT_EQ(writer_a.matched(), 1);
}

TEST(Participants, ASilentWriterIsNoticed) {
  Received<PublishedMap> received;
  const Participant there(config_of("silent"), "there"), here(config_of("silent"), "here");
  const Reader<PublishedMap> reader(there, received.callbacks());
  Writer<PublishedMap> writer(here);
  ASSERT_TRUE(matched(writer));
  ASSERT_TRUE(writer.write(map_of(1)));
  ASSERT_TRUE(received.wait_for_samples(1));
  // Its participant lives on, yet nothing is written: manual liveliness runs out.
  EXPECT_TRUE(received.wait_for_missed_deadline());
  EXPECT_TRUE(received.wait_for_alive(0));
}

TEST(Participants, AGoneWriterIsUnmatchedAndANewOneMatches) {
  Received<VehiclePose> received;
  const Participant there(config_of("gone"), "there"), here(config_of("gone"), "here");
  const Reader<VehiclePose> reader(there, received.callbacks());
  {
    const Writer<VehiclePose> writer(here);
    ASSERT_TRUE(matched(reader));
  }
  for (int i = 0; i < 2000 && reader.matched() > 0; ++i) usleep(10'000);
  EXPECT_EQ(reader.matched(), 0);
  Writer<VehiclePose> writer(here);
  ASSERT_TRUE(matched(writer) && matched(reader));
  ASSERT_TRUE(writer.write(VehiclePose{.sequence = 3}));
  ASSERT_TRUE(received.wait_for_samples(1));
}

TEST(Participants, MalformedPayloadsAreCountedAndGoodOnesFollow) {
  Received<DetectionFrame> received;
  const auto config = config_of("malformed");
  const Participant there(config, "there"), here(config, "here");
  const Reader<DetectionFrame> reader(there, received.callbacks());

  RawWriter<DetectionFrame> raw(here);
  ASSERT_TRUE(matched(raw));
  ASSERT_TRUE(matched(reader));
  std::vector<std::uint8_t> garbage(64, 0xff);
  garbage[0] = 0;
  garbage[1] = 1;
  std::vector<std::uint8_t> empty(4, 0);
  ASSERT_TRUE(raw.write(garbage));
  ASSERT_TRUE(raw.write(empty));
  ASSERT_TRUE(received.wait_for_refusals(2));
  EXPECT_EQ(received.refused(), (std::vector<std::string>{"crc", "malformed"}));

  const Participant honest(config, "honest");
  Writer<DetectionFrame> writer(honest);
  ASSERT_TRUE(matched(reader, 2) && matched(writer));
  ASSERT_TRUE(writer.write(frame_of(9)));
  ASSERT_TRUE(received.wait_for_samples(1));
  EXPECT_EQ(received.samples()[0].sequence, 9U);
}

TEST(Participants, ACallbackThatThrowsDoesNoHarm) {
  Received<VehiclePose> received;
  auto callbacks = received.callbacks();
  const auto store = callbacks.sample;
  callbacks.sample = [&](VehiclePose&& pose) {
    const bool first = pose.sequence == 1;
    store(std::move(pose));
    if (first) throw std::runtime_error("no");
  };
  const Participant there(config_of("throws"), "there"), here(config_of("throws"), "here");
  const Reader<VehiclePose> reader(there, callbacks);
  Writer<VehiclePose> writer(here);
  ASSERT_TRUE(matched(writer) && matched(reader));
  ASSERT_TRUE(writer.write(VehiclePose{.sequence = 1}) && writer.write(VehiclePose{.sequence = 2}));
  EXPECT_TRUE(received.wait_for_samples(2));
}

TEST(Participants, ATopicHasOneType) {
  Participant::Impl here(config_of("type"), "here", Participant::Presence::hidden);
  const auto detections = topic_of<DetectionFrame, TopicTraits<DetectionFrame>::Type>().type;
  const auto map = topic_of<PublishedMap, TopicTraits<PublishedMap>::Type>().type;
  auto* const topic = here.topic("x", detections);
  EXPECT_EQ(here.topic("x", detections), topic);
  EXPECT_THROW(here.topic("x", map), ConfigError);
}

/// A raw reader that shares its topic with another reader would take the samples of that one for its own.
TEST(Participants, ATopicIsRawOrNot) {
  const auto no_message = [](const WriterId& /*writer*/, std::vector<std::uint8_t>&& /*message*/) {};
  const Participant here(config_of("raw"), "here", Participant::Presence::hidden);
  const Reader<VehiclePose> reader(here, {});
  EXPECT_THROW(RawReader<VehiclePose>(here, no_message), ConfigError);
  EXPECT_THROW(RawWriter<VehiclePose>{here}, ConfigError);
  EXPECT_NO_THROW(Writer<VehiclePose>{here});
  const RawReader<DetectionFrame> raw(here, no_message);
  EXPECT_THROW(Reader<DetectionFrame>(here, {}), ConfigError);
}

TEST(Participants, AValueOutsideItsRangeIsRefused) {
  const auto refused = [](const DdsConfig& config, const std::string& key) {
    const auto names_the_key = [&](const std::function<void()>& make) {
      try {
        make();
      } catch (const ConfigError& error) {
        return std::string(error.what()).starts_with(key + ": ");
      }
      return false;
    };
    return names_the_key([&] { const Participant one(config, "p"); }) &&
           names_the_key([&] { const Discovery one(config, "d"); });
  };
  EXPECT_TRUE(refused({.domain = 233}, "dds.domain"));
  EXPECT_TRUE(refused({.domain = -1}, "dds.domain"));
  EXPECT_TRUE(refused({.vehicle_id = "car_?"}, "dds.vehicle_id")) << "it would be in all partitions of cars";
  EXPECT_TRUE(refused({.vehicle_id = ""}, "dds.vehicle_id"));
  EXPECT_TRUE(refused({.transport = "tcp"}, "dds.transport"));
}

TEST(Participants, ABadProfileStopsTheStart) {
  auto config = config_of("profile");
  config.profile_name = "mine";
  config.profile_file = "/nonexistent/profiles.xml";
  EXPECT_THROW(Participant(config, "p"), std::runtime_error);

  const TemporaryFolder folder;
  const auto path = folder.file("profiles.xml");
  config.profile_file = path;
  std::ofstream(path) << "<profiles><participant";
  EXPECT_THROW(Participant(config, "p"), std::runtime_error);

  std::ofstream(path)
      << R"(<?xml version="1.0"?><profiles xmlns="http://www.eprosima.com/XMLSchemas/fastRTPS_Profiles">
    <participant profile_name="other"><rtps><name>x</name></rtps></participant></profiles>)";
  EXPECT_THROW(Participant(config, "p"), std::runtime_error);
  config.profile_name = "other";
  EXPECT_NO_THROW(Participant(config, "p"));
  EXPECT_NO_THROW(Participant(config, "once more"));
}

}  // namespace
}  // namespace laneloom::dds
