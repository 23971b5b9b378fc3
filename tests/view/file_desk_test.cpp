#include "view/file_desk.hpp"

#include <gmock/gmock.h>

#include <atomic>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

namespace laneloom::view {
namespace {

using nlohmann::json;

/// A desk whose files say their frame, and are read until a stop is requested.
class Desk : public testing::Test {
 protected:
  static io::WorkFolder put(const std::string& content) {
    io::WorkFolder folder;
    std::ofstream(folder.file(WebServer::kFileName)) << content;
    return folder;
  }

  /// The answer to a path of the file, once it has frames.
  std::string once_read(const std::string& target) const {
    while (json::parse(desk_.answer("/recording?from=0&view=" + target.substr(target.find("view=") + 5)).body)
               .at("frames")
               .empty())
      std::this_thread::yield();
    return desk_.answer(target).body;
  }

  FrameStore frames_;
  Site own_{{.title = "own"}, frames_};
  std::filesystem::path file_;
  std::atomic<int> reading_ = 0;
  FileDesk desk_{own_,
                 [this](const std::filesystem::path& file, FrameStore& store, const std::stop_token& stop) {
                   ++reading_;
                   std::ifstream in(file);
                   std::string frame;
                   in >> frame;
                   file_ = file;
                   store.add(0, "{}", frame);
                   while (!stop.stop_requested()) std::this_thread::yield();
                   --reading_;
                 },
                 100};
};

TEST_F(Desk, ShowsTheFileThatWasOpenedLastBesideItsOwnView) {
  EXPECT_EQ(desk_.answer("/info?view=1").status, 410U);
  EXPECT_EQ(desk_.open("/open?name=a.mcap", put("first")).body, R"({"view":1})");
  EXPECT_EQ(json::parse(desk_.answer("/info?view=1").body)["title"], "a.mcap");
  EXPECT_EQ(json::parse(desk_.answer("/info?view=1").body)["max_file_bytes"], 100U);
  EXPECT_EQ(json::parse(desk_.answer("/info").body)["title"], "own");
  EXPECT_EQ(desk_.answer("/frame?number=0").status, 404U) << "its own view has none";
  EXPECT_EQ(once_read("/frame?number=0&view=1"), "first");
  const std::filesystem::path first = file_;
  EXPECT_EQ(first.filename(), "a.mcap");
  EXPECT_EQ(desk_.open("/open?name=b.frames.jsonl", put("second")).body, R"({"view":2})");
  EXPECT_EQ(once_read("/frame?number=0&view=2"), "second");
  EXPECT_EQ(reading_, 1) << "the first one is read no longer";
  EXPECT_FALSE(std::filesystem::exists(first.parent_path()));
  for (const char* gone : {"/frame?number=0&view=1", "/?view=1", "/info?view=3", "/info?view=x"})
    EXPECT_EQ(desk_.answer(gone).status, 410U) << gone;
}

TEST_F(Desk, TakesNamesThatStayInTheirFolder) {
  for (const char* name : {"", "..", ".hidden", "a/b", "../a", "a%2Fb", "a b", "\xC3\xA4.mcap", "a\\b"}) {
    const WebAnswer answer = desk_.open("/open?name=" + std::string(name), put("x"));
    EXPECT_EQ(answer.status, 400U) << name;
  }
  EXPECT_EQ(desk_.open("/open", put("x")).status, 400U);
  EXPECT_EQ(desk_.open("/open?name=" + std::string(101, 'a'), put("x")).status, 400U);
  EXPECT_EQ(reading_, 0);
  EXPECT_EQ(desk_.open("/open?name=" + std::string(100, 'a'), put("x")).status, 200U);
}

}  // namespace
}  // namespace laneloom::view
