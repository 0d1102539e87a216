#include "desk/desk_json.h"

#include <limits>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "limpid/files/text/look_file.h"

#include "desk/pond_desk.h"
#include "paths.h"

namespace limpid::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(DeskRequestTest, HoldsSettingsInTheirOrder) {
  const NewPicture request = picture_request(
      R"({"look": "pond", "set": {"z.text": "some words", "a.number": 0.1, "m.color": [1, 0.5, 0],
          "b.rows": [[1, 2], [3, 4]], "b.none": []}, "frame": 7, "time": 1.5, "half": true,
          "show": "dry", "exposure": -2, "display": "wall/half", "instead": true})");
  EXPECT_EQ(request.look, "pond");
  EXPECT_THAT(request.settings,
              ElementsAre("z.text=some words", "a.number=0.1", "m.color=[1.0, 0.5, 0.0]",
                          "b.rows=[[1.0, 2.0], [3.0, 4.0]]", "b.none=[]"));
  EXPECT_EQ(request.frame, 7);
  EXPECT_EQ(request.time, 1.5);
  EXPECT_TRUE(request.half);
  EXPECT_EQ(request.show, "dry");
  EXPECT_EQ(request.exposure, -2);
  EXPECT_EQ(request.display, "wall/half");
  EXPECT_TRUE(request.instead);
}

TEST(DeskRequestTest, LeavesOutWhatIsUsual) {
  const NewPicture request = picture_request(R"({"look": "pond", "frame": null, "time": null})");
  EXPECT_FALSE(request.instead);
  EXPECT_FALSE(request.frame);
  EXPECT_FALSE(request.time);
  EXPECT_FALSE(request.half);
  EXPECT_EQ(request.show, "picture");
  EXPECT_EQ(request.exposure, 0);
}

TEST(DeskRequestTest, RefusesWhatIsWrongInASentence) {
  const auto refused = [](const std::string& json) {
    return refusal([&] { picture_request(json); });
  };
  EXPECT_EQ(refused(""), "request: expected a JSON object");
  EXPECT_EQ(refused("[1]"), "request: expected a JSON object");
  EXPECT_EQ(refused(R"({"look": "a")"), "request: expected a JSON object");
  EXPECT_EQ(refused(std::string(100000, '[')), "request: expected a JSON object");
  EXPECT_EQ(refused("{}"), "request: look: expected a string");
  EXPECT_EQ(refused(R"({"look": 1})"), "request: look: expected a string");
  EXPECT_EQ(refused(R"({"look": "a", "half": 1})"), "request: half: expected true or false");
  EXPECT_EQ(refused(R"({"look": "a", "show": 1})"), "request: show: expected a string");
  EXPECT_EQ(refused(R"({"look": "a", "exposure": "1"})"), "request: exposure: expected a number");
  EXPECT_EQ(refused(R"({"look": "a", "frame": 1.5})"), "request: frame: expected a whole number");
  EXPECT_EQ(refused(R"({"look": "a", "frame": 3000000000})"),
            "request: frame: expected a whole number");
  EXPECT_EQ(refused(R"({"look": "a", "time": 1e300})"),
            "request: time: expected -1e12 ... 1e12 (s)");
  EXPECT_EQ(refused(R"({"look": "a", "set": []})"), "request: set: expected an object of settings");
  EXPECT_EQ(
      refused(R"({"look": "a", "set": {"a.b": true}})"),
      "request: set: a.b: expected a number, a string, or a list of numbers or of rows of numbers");
  EXPECT_EQ(refused(R"({"look": "a", "hlf": true})"),
            "request: unknown key 'hlf': expected some of look, set, frame, time, half, show, "
            "exposure, display, instead; did you mean 'half'?");
  EXPECT_EQ(refusal([] { pixel_request(R"({"look": "a", "x": 1})"); }),
            "request: y: expected a whole number");
  EXPECT_EQ(refusal([] { save_request(R"({"look": "a"})"); }), "request: name: expected a string");
  EXPECT_THAT(refusal([] { choice_request(R"({"look": "a", "half": true})"); }),
              HasSubstr("unknown key 'half'"));
}

TEST(DeskReplyTest, HasThePixelsBehindTheirFacts) {
  DeskPicture picture;
  picture.shown.size = {2, 1};
  picture.shown.rgba = {1, 2, 3, 255, 4, 5, 6, 255};
  picture.shown.scale = {0, 4};
  picture.milliseconds = {{"all", 3}, {"read", 1}};
  picture.unread = {{"depth_fog.ambient", "the environment lights the water"}};
  picture.replaced = {{"wave_normals.model", "plate", "the frame has surface normals"}};
  picture.warnings = {"too much \xff water"};
  const std::string bytes = picture_bytes(picture);
  std::size_t size = 0;
  for (int i = 3; i >= 0; --i) size = size << 8 | static_cast<unsigned char>(bytes[i]);
  const auto facts = nlohmann::json::parse(bytes.substr(4, size));
  EXPECT_EQ(facts["width"], 2);
  EXPECT_EQ(facts["height"], 1);
  EXPECT_EQ(facts["milliseconds"]["all"], 3);
  EXPECT_EQ(facts["scale"], nlohmann::json({0, 4}));
  EXPECT_EQ(facts["unread"][0]["key"], "depth_fog.ambient");
  EXPECT_EQ(facts["unread"][0]["why"], "the environment lights the water");
  EXPECT_EQ(facts["replaced"][0]["key"], "wave_normals.model");
  EXPECT_EQ(facts["replaced"][0]["value"], "plate");
  EXPECT_TRUE(facts["wet"].is_null());
  EXPECT_EQ(bytes.substr(4 + size), std::string("\1\2\3\xff\4\5\6\xff"));
}

TEST(DeskReplyTest, HasNullForWhatIsNotFinite) {
  PixelNumbers numbers;
  numbers.picture = {std::numeric_limits<float>::quiet_NaN(), 1, 2};
  numbers.aovs = {{Aov::kSurfaceDepth, {std::numeric_limits<float>::infinity()}},
                  {Aov::kTransmittance, {0.5f, 0.25f, 1}}};
  PixelRequest request;
  request.x = 3;
  const auto json = nlohmann::json::parse(pixel_json(request, numbers));
  EXPECT_EQ(json["x"], 3);
  EXPECT_TRUE(json["picture"][0].is_null());
  EXPECT_TRUE(json["aovs"]["surface_depth"]["Z"].is_null());
  EXPECT_EQ(json["aovs"]["transmittance"]["G"], 0.25);
}

using DeskJsonTest = PondDesk;

TEST_F(DeskJsonTest, HasAllFieldsOfAllOperators) {
  DeskOptions options = this->options();
  options.settings = {"depth_fog.density = 3"};
  Desk desk(options, *executor_);
  const auto json = nlohmann::json::parse(desk_json(desk));
  EXPECT_EQ(json["size"], nlohmann::json({64, 36}));
  EXPECT_EQ(json["window"], nlohmann::json({0, 0, 64, 36}));
  EXPECT_EQ(json["plate"], "plate.exr");
  EXPECT_EQ(json["runner"], "fused scalar");
  EXPECT_EQ(json["displays"], nlohmann::json({"sRGB"}));
  EXPECT_EQ(json["set"], nlohmann::json({{"depth_fog.density", 3.0}}));
  EXPECT_TRUE(json["frame"].is_null());
  std::size_t fields = 0;
  for (const auto& op : json["operators"]) {
    for (const auto& field : op["fields"]) {
      ++fields;
      EXPECT_FALSE(field["about"].get<std::string>().empty());
      const auto& values = json["looks"][0]["values"];
      EXPECT_TRUE(values[op["name"].get<std::string>()].contains(field["name"].get<std::string>()));
    }
  }
  EXPECT_EQ(fields, parameters(Look{}).size());
}

TEST_F(DeskJsonTest, TellsPresetsFromLooksAndWhatTheyAreFor) {
  DeskOptions options = this->options();
  options.looks = {{"physical", load_look(LIMPID_DATA "/looks/physical.toml")},
                   {"harbour", load_look(LIMPID_DATA "/presets/harbour.toml")}};
  options.start = "harbour";
  Desk desk(options, *executor_);
  const auto json = nlohmann::json::parse(desk_json(desk));
  EXPECT_EQ(json["looks"][0]["preset"], false);
  EXPECT_EQ(json["looks"][1]["preset"], true);
  EXPECT_EQ(json["looks"][1]["about"], options.looks[1].look.about);
  EXPECT_EQ(json["looks"][1]["values"]["depth_fog"]["sediment"], 10);
}

}  // namespace
}  // namespace limpid::test
