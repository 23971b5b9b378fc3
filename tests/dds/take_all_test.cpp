#include "dds/take_all.hpp"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <random>
#include <string>
#include <vector>

#include "dds/participant_impl.hpp"
#include "dds/topic_traits.hpp"
#include "laneloom/dds/cdr.hpp"
#include "laneloom/dds/reader.hpp"
#include "own_domain.hpp"

// A writer that gives up samples half sent. Its datagrams are made by hand: a real one gives up under load
// only.
namespace laneloom::dds {
namespace {

namespace fast = eprosima::fastdds::dds;
using eprosima::fastdds::rtps::GUID_t;
using Bytes = std::vector<std::uint8_t>;

constexpr std::uint32_t kPartBytes = 100, kParts = 3;

Bytes frame_bytes() {
  DetectionFrame frame;
  frame.detections.push_back(Detection{.confidence = 0.5, .points = {{0, 0, 0}, {1, 2, 3}}});
  Bytes bytes;
  to_cdr(frame, "map", bytes);
  bytes.resize((bytes.size() + 3) / 4 * 4);
  return bytes;
}

/// Submessages of RTPS from one writer to all its readers.
class Datagram {
 public:
  explicit Datagram(const GUID_t& writer) : writer_(writer) {
    for (const char c : std::string("RTPS\2\3\1\17", 8)) bytes_.push_back(static_cast<std::uint8_t>(c));
    put(bytes_, writer.guidPrefix.value);
    Bytes time;
    put(time, std::uint64_t{1'700'000'000});
    add(0x09, 0x01, time);
  }

  Datagram& whole(std::uint32_t number, const Bytes& payload) {
    Bytes body = begin(number, 16);
    body.insert(body.end(), payload.begin(), payload.end());
    return add(0x15, 0x05, body);
  }
  /// The `part` of `kParts`, from 1.
  Datagram& part(std::uint32_t number, std::uint32_t part) {
    Bytes body = begin(number, 28);
    put(body, part);
    put(body, std::uint16_t{1});
    put(body, static_cast<std::uint16_t>(kPartBytes));
    put(body, kParts * kPartBytes);
    body.resize(body.size() + kPartBytes);
    return add(0x16, 0x01, body);
  }
  /// The samples in [first, end) will never come.
  Datagram& gap(std::uint32_t first, std::uint32_t end) {
    Bytes body;
    put_addresses(body);
    put_number(body, first);
    put_number(body, end);
    put(body, std::uint32_t{0});
    return add(0x08, 0x01, body);
  }
  const Bytes& bytes() const { return bytes_; }

 private:
  template <class T>
  static void put(Bytes& to, const T& value) {
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(&value);
    to.insert(to.end(), bytes, bytes + sizeof value);
  }
  static void put_number(Bytes& to, std::uint32_t number) {
    put(to, std::uint32_t{0});
    put(to, number);
  }
  void put_addresses(Bytes& to) const {
    put(to, std::uint32_t{0});
    put(to, writer_.entityId.value);
  }
  Bytes begin(std::uint32_t number, std::uint16_t octets_to_inline_qos) const {
    Bytes body;
    put(body, std::uint16_t{0});
    put(body, octets_to_inline_qos);
    put_addresses(body);
    put_number(body, number);
    return body;
  }
  Datagram& add(std::uint8_t kind, std::uint8_t flags, const Bytes& body) {
    put(bytes_, kind);
    put(bytes_, flags);
    put(bytes_, static_cast<std::uint16_t>(body.size()));
    bytes_.insert(bytes_.end(), body.begin(), body.end());
    return *this;
  }

  GUID_t writer_;
  Bytes bytes_;
};

/// Counts what comes to a reader.
class Counter : public fast::DataReaderListener {
 public:
  void on_data_available(fast::DataReader* reader) override {
    using Frame = Sample<msg::Detections>;
    take_all<Frame>(*reader, [this](const Frame& frame, const fast::SampleInfo& info) {
      const auto number = info.sample_identity.sequence_number().low;
      const std::lock_guard lock(mutex_);
      if (!frame.refusal.empty()) ++refused_;
      newest_ = std::max(newest_, number);
      changed_.notify_all();
    });
  }
  bool has(std::uint32_t number, std::chrono::milliseconds patience) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, patience, [&] { return newest_ >= number; });
  }
  int refused() const { return refused_; }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::uint32_t newest_ = 0;
  std::atomic<int> refused_ = 0;
};

class HalfSent : public testing::Test {
 protected:
  HalfSent() {
    auto qos = reader_qos(TopicKind::detections, fast::RELIABLE_RELIABILITY_QOS);
    qos.history().depth = 64;  // the more the list holds, the more often does an entry equal another one
    reader_ = there_.impl()->subscriber().create_datareader(topic(there_), qos, &counter_);
    writer_ = here_.impl()->publisher().create_datawriter(topic(here_), writer_qos(TopicKind::detections));
  }
  ~HalfSent() override {
    reader_->set_listener(nullptr);
    there_.impl()->subscriber().delete_datareader(reader_);
    here_.impl()->publisher().delete_datawriter(writer_);
    close(socket_);
  }
  static fast::Topic* topic(const Participant& participant) {
    const auto description = topic_of<DetectionFrame, TopicTraits<DetectionFrame>::Type>();
    return participant.impl()->topic(description.name, description.type);
  }
  bool matched(int readers) const {
    fast::PublicationMatchedStatus writer;
    fast::SubscriptionMatchedStatus reader;
    for (int i = 0; i < 2000 && (writer.current_count < readers || reader.current_count < 1); ++i) {
      usleep(10'000);
      writer_->get_publication_matched_status(writer);
      reader_->get_subscription_matched_status(reader);
    }
    return writer.current_count >= readers && reader.current_count >= 1;
  }
  Datagram datagram() const { return Datagram(writer_->guid()); }
  void send(const Datagram& datagram) const {
    eprosima::fastdds::rtps::LocatorList locators;
    reader_->get_listening_locators(locators);
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    to.sin_port = htons(eprosima::fastdds::rtps::IPLocator::getPhysicalPort(*locators.begin()));
    const auto& bytes = datagram.bytes();
    const auto sent =
        sendto(socket_, bytes.data(), bytes.size(), 0, reinterpret_cast<const sockaddr*>(&to), sizeof to);
    ASSERT_EQ(sent, static_cast<ssize_t>(bytes.size()));
  }

  DdsConfig config_{.domain = own_domain(), .vehicle_id = "half" + std::to_string(getpid())};
  Participant there_{config_, "there"}, here_{config_, "here"};
  Counter counter_;
  fast::DataReader* reader_ = nullptr;
  fast::DataWriter* writer_ = nullptr;
  int socket_ = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
};

// With take_next_sample() instead, Fast DDS ends the process within some rounds.
TEST_F(HalfSent, SamplesThatAreGivenUpDoNoHarm) {
  ASSERT_TRUE(matched(1));
  std::mt19937 engine(1);
  const auto random = [&] { return static_cast<std::uint32_t>(engine()); };
  std::uint32_t next = 1;
  for (int round = 0; round < 100; ++round) {
    std::vector<std::uint32_t> begun;
    for (int i = 0; i < 20; ++i) {
      const auto dice = random() % 10;
      auto message = datagram();
      if (dice < 5 || begun.empty()) {
        begun.push_back(next);
        message.part(next++, 1 + random() % kParts);
      } else if (dice < 8) {
        std::swap(begun[random() % begun.size()], begun.back());
        message.gap(begun.back(), begun.back() + 1);
        begun.pop_back();
      } else {
        message.whole(next++, frame_bytes());
      }
      send(message);
    }
    const std::uint32_t last = next++;
    for (int i = 0; i < 200 && !counter_.has(last, std::chrono::milliseconds(i == 0 ? 0 : 100)); ++i)
      send(datagram().gap(1, last).whole(last, frame_bytes()));
    ASSERT_TRUE(counter_.has(last, std::chrono::seconds(0))) << "round " << round;
  }
  EXPECT_EQ(counter_.refused(), 0);
}

TEST_F(HalfSent, SamplesThatAreGivenUpAreNotRefused) {
  std::mutex mutex;
  std::condition_variable arrived;
  int frames = 0;
  std::vector<std::string> refused;
  ReaderCallbacks<DetectionFrame> callbacks;
  callbacks.sample = [&](DetectionFrame&& /*frame*/) {
    const std::lock_guard lock(mutex);
    ++frames;
    arrived.notify_all();
  };
  callbacks.refused = [&](std::string_view reason) {
    const std::lock_guard lock(mutex);
    refused.emplace_back(reason);
  };
  const Reader<DetectionFrame> reader(there_, callbacks);
  ASSERT_TRUE(matched(3));
  for (int i = 0; i < 2000 && reader.matched() == 0; ++i) usleep(10'000);

  const auto arrive = [&](int count) {
    std::unique_lock lock(mutex);
    return arrived.wait_for(lock, std::chrono::seconds(20), [&] { return frames >= count; });
  };
  // The third sample is sent twice: what was given up fills the reader, which refuses the first time.
  auto given_up = datagram().part(1, 1).part(2, 1).gap(2, 3).gap(1, 2);
  send(given_up.whole(3, frame_bytes()).whole(3, frame_bytes()));
  ASSERT_TRUE(arrive(1));
  send(datagram().whole(4, frame_bytes()));  // when it comes, all readers have done with what came before
  ASSERT_TRUE(arrive(2));
  const std::lock_guard lock(mutex);
  EXPECT_TRUE(refused.empty()) << refused.front();
}

}  // namespace
}  // namespace laneloom::dds
