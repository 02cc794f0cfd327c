// Sections of a scene: what they take, refuse and leave.
#include "apps/scene/overrides.h"
#include "apps/scene/reader.h"
#include "apps/scene/section.h"

#include <catch2/catch.hpp>

using apps::Need;
using apps::Range;
using Catch::Contains;

namespace
{
  enum class Colour
  {
    red,
    green
  };

  /** A section of every type of entry, and the members that it is bound to. */
  struct Palette
  {
    Palette()
    {
      apps::Section &s = root.section("Palette", "for tests");
      s.number("Width", width, "m", Range::positive(), Need::required).means("of the brush");
      s.integer("Strokes", strokes, "", Range::between(1, 10), Need::optional);
      s.choice("Colour", colour, {{"red", Colour::red}, {"deep green", Colour::green}}, Need::optional);
      s.flag("Wet", wet);
      s.vector("Place", place, "m", {}, Need::optional);
      s.number("Drying time", drying, "s", Range::at_least(0), Need::required).only_if([this] { return wet; }, "Wet");
      apps::Section &frame = root.section("Frame", "");
      frame.only_if([this] { return framed; }, "there is one");
      frame.number("Depth", depth, "m", Range::positive(), Need::required);
      root.section("Layers", "").named_sections("LAYER", [this](apps::Section &opened) {
        layers.push_back(opened.name());
        opened.number("Opacity", opacity, "-", Range::from_up_to(0, 1), Need::optional);
      });
    }

    void set(const std::vector<std::string> &texts) { assign(root, apps::read_overrides(texts), "test"); }

    apps::Section            root;
    double                   width = 0, drying = 0, depth = 0, opacity = 0.5;
    std::int64_t             strokes = 3;
    Colour                   colour  = Colour::red;
    bool                     wet = false, framed = false;
    std::array<double, 3>    place{};
    std::vector<std::string> layers;
  };

  std::string refusal(const std::vector<std::string> &texts)
  {
    Palette palette;
    try
      {
        palette.set(texts);
      }
    catch (const base::InputError &refused)
      {
        return refused.what();
      }
    return "taken";
  }
} // namespace

TEST_CASE("A section brings values into the members that it is bound to, and leaves the others", "[apps]")
{
  Palette palette;
  palette.set({"Palette/Width=2.5e-2", "palette/colour = Deep Green", "Palette/Place=1, 2,3", "Palette/Width=3e-2"});
  CHECK(palette.width == 3e-2); // the later one
  CHECK(palette.colour == Colour::green);
  CHECK(palette.place == std::array<double, 3>{1, 2, 3});
  CHECK(palette.strokes == 3);
  CHECK_FALSE(palette.wet);
  const apps::Section &s = *palette.root.find_section("Palette");
  CHECK(s.find_entry("Width")->set);
  CHECK_FALSE(s.find_entry("Strokes")->set);
  CHECK(s.find_entry("Strokes")->value == "3");
  CHECK(s.path_of("Width") == "Palette/Width");
}

TEST_CASE("What a section does not take is refused with what was found and what is allowed", "[apps]")
{
  const std::string width = "Palette/Width=1";
  CHECK(refusal({width}) == "taken");
  CHECK_THAT(refusal({}), Contains("\"Palette/Width\" [m] is not set and has no default."));
  CHECK_THAT(refusal({"Palette/Width=0"}), Contains("Palette/Width = 0: expected a number > 0 [m]"));
  CHECK_THAT(refusal({"Palette/Width=nan"}), Contains("Palette/Width = nan"));
  CHECK_THAT(refusal({"Palette/Width=wide"}), Contains("Palette/Width = wide"));
  CHECK_THAT(refusal({width, "Palette/Strokes=2.5"}), Contains("Palette/Strokes = 2.5: expected a whole number"));
  CHECK_THAT(refusal({width, "Palette/Strokes=11"}), Contains("in [1, 10]"));
  CHECK_THAT(refusal({width, "Palette/Colour=blue"}), Contains("red, deep green"));
  CHECK_THAT(refusal({width, "Palette/Place=1,2"}), Contains("Palette/Place = 1,2"));
  CHECK_THAT(refusal({width, "Palette/Strokse=2"}), Contains("Did you mean \"Strokes\"?"));
  CHECK_THAT(refusal({width, "Pallete/Strokes=2"}), Contains("Did you mean \"Palette\"?"));
  CHECK_THAT(refusal({width, "Layers/ground/Opacity=1"}), Contains("[0, 1)"));
}

TEST_CASE("An entry is needed only where its condition, or that of its section, holds after reading", "[apps]")
{
  CHECK_THAT(refusal({"Palette/Width=1", "Palette/Wet=true"}), Contains("\"Palette/Drying time\" [s] is not set"));
  CHECK(refusal({"Palette/Wet=true", "Palette/Drying time=0", "Palette/Width=1"}) == "taken");
  Palette framed;
  framed.framed = true;
  CHECK_THROWS_WITH(framed.set({"Palette/Width=1"}), Contains("\"Frame/Depth\" [m] is not set"));
  CHECK_FALSE(framed.root.find_section("Palette")->find_entry("Drying time")->needed());
}

TEST_CASE("Sections whose names are the scene's choice are opened in its order, each with entries of its own", "[apps]")
{
  Palette palette;
  palette.set({"Palette/Width=1", "Layers/varnish/Opacity=0.1", "Layers/ground/Opacity=0.9"});
  CHECK(palette.layers == std::vector<std::string>{"varnish", "ground"});
  CHECK(palette.root.find_section("Layers")->section_names() == palette.layers);
  CHECK(palette.root.find_section("Layers")->find_section("ground")->find_entry("Opacity")->value == "0.9");
}

TEST_CASE("A rule between entries is refused at the place of its entry", "[apps]")
{
  Palette palette;
  palette.set({"Palette/Width=1"});
  CHECK_THROWS_WITH(palette.root.find_section("Palette")->refuse("Width", "is too wide."),
                    Contains("command line") && Contains("Palette/Width = 1: is too wide."));
}

TEST_CASE("A range knows what lies in it, and no range has what is not a number", "[apps]")
{
  CHECK(Range::from_up_to(0, 1).contains(0));
  CHECK_FALSE(Range::from_up_to(0, 1).contains(1));
  CHECK(Range::between(0, 1).contains(1));
  CHECK_FALSE(Range::positive().contains(0));
  CHECK_FALSE(Range().contains(std::nan("")));
  CHECK_FALSE(Range().contains(std::numeric_limits<double>::infinity()));
  CHECK(Range::from_up_to(0, 1).text() == "in [0, 1)");
  CHECK(Range().text().empty());
}
