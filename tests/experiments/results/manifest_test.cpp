/// A manifest from anywhere: whatever it holds, every command that reads it answers in a line.

#include <gtest/gtest.h>

#include <algorithm>

#include "support/toy_program.hpp"

namespace thinwall {
namespace {

struct ManifestTest : ToyProgram {
  std::string good;

  void SetUp() override {
    ASSERT_EQ(run({"--seed", "3", "--trials", "7"}).status, 0);
    good = read_text(out + "/manifest.json");
  }

  /// Every command that reads the manifest, which says `text`, names `fault` in a line.
  void expect_fault(const std::string& text, const std::string& fault) const {
    SCOPED_TRACE(fault);
    write_text(out + "/manifest.json", text);
    for (const char* command : {"report", "cite", "reproduce"}) {
      const Reply reply = call({command, out});
      EXPECT_EQ(reply.status, 2) << command;
      EXPECT_EQ(reply.err, out + "/manifest.json: " + fault + "\n") << command;
    }
    EXPECT_EQ(run().err, "--out " + out + ": holds a manifest.json that is not ours (manifest.json: " + fault +
                             "); name another folder\n");
    const Reply check = call({"report", out, "--check"});
    EXPECT_EQ(check.status, 1);
    EXPECT_TRUE(check.out.starts_with("manifest.json: " + fault + "\n")) << check.out;
    write_text(out + "/manifest.json", good);
  }

  /// The same, with `value` where `pointer` leads.
  void expect_fault(const std::string& pointer, const nlohmann::json& value, const std::string& fault) const {
    nlohmann::json json = nlohmann::json::parse(good);
    json[nlohmann::json::json_pointer(pointer)] = value;
    expect_fault(json.dump(), fault);
  }
};

TEST_F(ManifestTest, of_another_type_or_out_of_range_is_named_by_its_key) {
  const std::string trials = " is not allowed; a whole number from 1 to 9223372036854775807";
  expect_fault("/trials", 0, "key 'trials': 0" + trials);
  expect_fault("/trials", -5, "key 'trials': -5" + trials);
  expect_fault("/trials", 3.5, "key 'trials': 3.5" + trials);
  expect_fault("/trials", 0x1p70, "key 'trials': 1.1805916207174113e+21" + trials);
  expect_fault("/trials", "7", "key 'trials': \"7\"" + trials);
  expect_fault("/seed", -1, "key 'seed': -1 is not allowed; a whole number from 0 to 18446744073709551615");
  const std::string toml = " is not allowed; an object of what TOML can hold: no null, no whole number above 2^63 - 1";
  expect_fault("/config", nlohmann::json::array(), "key 'config': []" + toml);
  expect_fault("/config", {{"cells", nullptr}}, "key 'config': {\"cells\":null}" + toml);
  expect_fault("/experiment", "a\x1b{}", "key 'experiment': \"a\\u001b{}\" is not allowed; a name of a-z, 0-9 and _");
  expect_fault("/program/commit", "a}, note={b",
               "key 'program.commit': \"a}, note={b\" is not allowed; hexadecimal digits, or \"unknown\"");
  expect_fault("/run_id", "%", "key 'run_id': \"%\" is not allowed; hexadecimal digits");
  expect_fault("/finished", "2031", "key 'finished': \"2031\" is not allowed; a time as 2031-02-03T04:05:06Z");
  expect_fault("/self_test_passed", 1, "key 'self_test_passed': 1 is not allowed; true or false");
  expect_fault("/files", {{"a", 1}}, "key 'files': {\"a\":1} is not allowed; an object of texts");
  expect_fault("/machine", nlohmann::json(), "key 'machine': null is not allowed; an object");
  expect_fault("/thinwall_manifest", 2, "key 'thinwall_manifest': 2 is not allowed; a whole number from 1 to 1");
}

TEST_F(ManifestTest, nested_deeper_than_anything_could_print_is_refused) {
  const std::string deep = std::string(20000, '[') + std::string(20000, ']');
  std::string text = good;
  text.replace(text.find("\"cells\": 20"), 11, "\"cells\": " + deep);
  const std::string fault = "is not one JSON object, nested at most 64 deep";
  expect_fault(text, fault);
  expect_fault(deep, fault);
  expect_fault(good.substr(0, good.size() / 2), fault);
  write_text(out + "/datapackage.json", deep);
  EXPECT_EQ(call({"report", out, "--check"}).status, 1);
  const std::string shard = folder / "shard";
  ASSERT_EQ(call({"run", "toy", "--shard", "1/1", "--out", shard}).status, 0);
  text = read_text(shard + "/shard.json");
  text.replace(text.find("\"cells\": 20"), 11, "\"cells\": " + deep);
  write_text(shard + "/shard.json", text);
  EXPECT_NE(call({"merge", shard}).err.find("its shard.json is damaged, or not ours"), std::string::npos);
}

}  // namespace
}  // namespace thinwall
