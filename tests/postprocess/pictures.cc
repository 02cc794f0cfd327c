#include "postprocess/pictures/break_pictures.h"
#include "postprocess/pictures/drawn_unit.h"
#include "postprocess/pictures/field_picture.h"
#include "postprocess/pictures/peak_words.h"
#include "postprocess/pictures/picture_axes.h"
#include "postprocess/pictures/plot.h"
#include "postprocess/pictures/specimen_picture.h"
#include "postprocess/vtk/break_log.h"
#include "scratch_folder.h"
#include "specimen_samples.h"
#include "tests/environment.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

using namespace postprocess;
using Catch::Matchers::Contains;
using postprocess_tests::content_of;
using postprocess_tests::files_in;
using postprocess_tests::ScratchFolder;

namespace
{
  /** Width and height from the header of a PNG file (big-endian numbers at bytes 16 and 20 of the IHDR chunk). */
  std::pair<unsigned, unsigned> size_of_png(const std::filesystem::path &path)
  {
    const std::string bytes = content_of(path);
    REQUIRE(bytes.substr(0, 8) == "\x89PNG\r\n\x1a\n");
    REQUIRE(bytes.substr(bytes.size() - 8, 4) == "IEND"); // complete to its end
    const auto number = [&](const std::size_t at) {
      unsigned value = 0;
      for (std::size_t i = at; i < at + 4; ++i)
        value = value << 8 | static_cast<unsigned char>(bytes[i]);
      return value;
    };
    return {number(16), number(20)};
  }

  PlotSeries points(const std::string &name, const std::vector<double> &x, const std::vector<double> &y)
  {
    PlotSeries made;
    made.name = name;
    made.x    = x;
    made.y    = y;
    return made;
  }

  PlotPanel simple_panel() { return {"title", "x [m]", "y [Pa]", false, false, {points("s", {1, 2, 3}, {1, 4, 9})}}; }
} // namespace

TEST_CASE("a plot of any points is drawn: one, equal, not finite, on logarithmic axes, with errors", "[postprocess]")
{
  constexpr double    nan = std::numeric_limits<double>::quiet_NaN();
  const ScratchFolder folder;
  PlotPanel           panel = simple_panel();
  SECTION("three") {}
  SECTION("one point") { panel.series = {points("", {1}, {1})}; }
  SECTION("all equal") { panel.series[0].y = {0, 0, 0}; }
  SECTION("not finite") { panel.series[0].y = {1, nan, 9}; }
  SECTION("zero on logarithmic axes")
  {
    panel.log_x = panel.log_y = true;
    panel.series[0].x         = {0, 1, 2};
    panel.series[0].y_error   = {1, 5, 1}; // larger than the value
  }
  SECTION("a name with everything that gnuplot could misread")
  {
    panel.title = panel.series[0].name = "it's \"100 %\" _{x}^2 \\ @ & ~\n$`";
  }
  SECTION("peak") { panel.series[0].mark_peak = true; }
  SECTION("an empty series beside a full one") { panel.series.push_back(points("none", {}, {})); }
  REQUIRE(plot(folder / "curve.png", {panel}) == "");
  REQUIRE(size_of_png(folder / "curve.png").first > 400);
  REQUIRE(files_in(folder.path) == 1);
}

TEST_CASE("a logarithmic axis ends where its points do", "[postprocess]")
{
  PlotPanel panel;
  panel.log_x  = true;
  panel.series = {points("one", {8, 0, 40}, {1, 1, 2}), points("two", {16, 64}, {1, std::nan("")})};
  CHECK(drawn_range(panel) == std::make_pair(8.0, 40.0)); // zero and what is not a number are no points
  const ScratchFolder folder;
  CHECK(plot(folder.path / "a.png", {panel}).empty());
}

TEST_CASE("a curve that begins or ends at its largest value has no peak", "[postprocess]")
{
  CHECK_THAT(peak_words({1, 2, 3}, {1, 4, 2}, 1), Contains("peak 4 at 2"));
  CHECK_THAT(peak_words({1, 2, 3}, {1, 2, 4}, 2), Contains("largest 4 at 3"));
  CHECK_THAT(peak_words({1, 2, 3}, {4, 2, 3}, 0), Contains("largest 4 at 1"));
}

TEST_CASE("panels stand side by side, three in a row", "[postprocess]")
{
  const ScratchFolder folder;
  REQUIRE(plot(folder / "1.png", {simple_panel()}) == "");
  REQUIRE(plot(folder / "2.png", {simple_panel(), simple_panel()}) == "");
  REQUIRE(plot(folder / "4.png", {simple_panel(), simple_panel(), simple_panel(), simple_panel()}) == "");
  const auto one = size_of_png(folder / "1.png"), two = size_of_png(folder / "2.png"),
             four = size_of_png(folder / "4.png");
  REQUIRE(two == std::make_pair(2 * one.first, one.second));
  REQUIRE(four == std::make_pair(3 * one.first, 2 * one.second));
}

TEST_CASE("the stress-strain panel is in MPa over 1e-3", "[postprocess]")
{
  const PlotPanel panel = stress_strain_panel("tension", {{"seed 1", {0, 1e-4}, {0, 3.5e6}}});
  REQUIRE(panel.series.size() == 1);
  REQUIRE(panel.series[0].x[1] == Approx(0.1));
  REQUIRE(panel.series[0].y[1] == Approx(3.5));
  REQUIRE(panel.series[0].mark_peak);
  REQUIRE_FALSE(stress_strain_panel("", {{"published", {0, 1e-4}, {0, 3e6}, false}}).series[0].mark_peak);
}

TEST_CASE("a plot that cannot be drawn says why, keeps the earlier picture, and does not throw", "[postprocess]")
{
  const ScratchFolder folder;
  const auto          path = folder.file("curve.png", "earlier");
  SECTION("gnuplot is missing")
  {
    const Environment no_programs("PATH", folder.path.string());
    REQUIRE(plot(path, {simple_panel()}) ==
            path.string() + ": not drawn: gnuplot is not installed (Debian package gnuplot-nox)");
  }
  SECTION("there is no folder for temporary files")
  {
    const Environment nowhere("TMPDIR", (folder / "nowhere").string());
    REQUIRE_THAT(plot(path, {simple_panel()}), Contains("no folder for temporary files (TMPDIR)"));
  }
  SECTION("gnuplot fails")
  {
    std::filesystem::create_directory(folder / "bin");
    const auto fake = folder.file("bin/gnuplot", "#!/bin/sh\necho cannot do this >&2\nexit 3\n");
    std::filesystem::permissions(fake, std::filesystem::perms::owner_all);
    const Environment only_fake("PATH", (folder / "bin").string());
    REQUIRE_THAT(plot(path, {simple_panel()}), Contains("gnuplot failed (status 3): cannot do this"));
  }
  SECTION("nothing to draw")
  {
    REQUIRE_THAT(plot(path, {}), Contains("there is no point to draw"));
    REQUIRE_THAT(plot(path, {{"t", "x", "y", false, true, {points("s", {1, 2}, {0, -1})}}}),
                 Contains("no point to draw"));
  }
  SECTION("columns of unequal length")
  {
    REQUIRE_THAT(plot(path, {{"t", "x", "y", false, false, {points("s", {1}, {})}}}), Contains("differ in length"));
  }
  SECTION("unwritable place")
  {
    REQUIRE_THAT(plot(folder / "no/curve.png", {simple_panel()}), Contains("does not exist"));
  }
  REQUIRE(content_of(path) == "earlier");
}

TEST_CASE("a picture of a specimen is drawn across each axis, with and without broken links", "[postprocess]")
{
  const ScratchFolder folder;
  const auto          particles = postprocess_tests::numbered_particles(30);
  const int           axis      = GENERATE(0, 1, 2);
  PictureSlab         slab;
  slab.axis      = axis;
  slab.thickness = 100; // all
  slab.magnify   = 10;
  REQUIRE(picture_of_specimen(folder / "a.png", particles, postprocess_tests::numbered_links(30), "it's", slab) == "");
  REQUIRE(picture_of_specimen(folder / "b.png", particles, dem::LinkOutput(), "intact", slab) == "");
  size_of_png(folder / "a.png");
  size_of_png(folder / "b.png");
  REQUIRE(content_of(folder / "a.png") != content_of(folder / "b.png"));
}

TEST_CASE("bodies stand beside the particles of a picture, which shows all of them", "[postprocess]")
{
  const ScratchFolder folder;
  const auto          particles = postprocess_tests::numbered_particles(30);
  PictureSlab         alone, beside;
  alone.thickness = beside.thickness = 100;
  beside.bodies                      = {{{0, 60}, {5, 60}, {5, 80}, {0, 80}}};
  REQUIRE(picture_of_specimen(folder / "a.png", particles, {}, "title", alone) == "");
  REQUIRE(picture_of_specimen(folder / "b.png", particles, {}, "title", beside) == "");
  const auto low = size_of_png(folder / "a.png"), high = size_of_png(folder / "b.png");
  CHECK(double(high.second) / high.first > double(low.second) / low.first);
}

TEST_CASE("only a link that has opened is drawn as a crack", "[postprocess]")
{
  const ScratchFolder folder;
  auto                particles = postprocess_tests::numbered_particles(3);
  dem::LinkOutput     link      = postprocess_tests::numbered_links(2);
  link.kind                     = {dem::LinkOutput::broken};
  const auto picture            = [&](const std::string &name, const dem::LinkOutput &links) {
    REQUIRE(picture_of_specimen(folder / name, particles, links, "title") == "");
    return content_of(folder / name);
  };

  // The second particle has moved away from the first along the link, see numbered_particles().
  const std::string without_link = picture("none.png", {});
  REQUIRE(picture("open.png", link) != without_link);
  link.kind = {dem::LinkOutput::contact};
  REQUIRE(picture("contact.png", link) == without_link);
  link.kind = {dem::LinkOutput::broken};
  particles.position[1].x() -= 2 * particles.displacement[1].x(); // now it has moved towards the first
  particles.displacement[1].x() *= -1;
  REQUIRE(picture("closed.png", link) == picture("none.png", {}));
}

TEST_CASE("glue that was torn and has opened is drawn as a crack", "[postprocess]")
{
  const ScratchFolder folder;
  const auto          particles = postprocess_tests::numbered_particles(3); // the second has moved along x
  const auto          picture   = [&](const std::string &name, const double side, const int torn) {
    dem::LinkOutput links;
    links.glue = {{1}, {0}, {{1 + side * 0.4, 0.25, 0.5}}, {{0, 0, 0}}, {torn}, {0}, {0}, {0}, {0}, {0}, {0}};
    REQUIRE(picture_of_specimen(folder / name, particles, links, "title") == "");
    return content_of(folder / name);
  };
  const std::string whole = picture("whole.png", -1, 0);
  CHECK(picture("open.png", -1, 1) != whole);
  CHECK(picture("closed.png", 1, 1) == whole);
}

TEST_CASE("what broke is drawn as wide as it was, an element of a joint narrower than the whole", "[postprocess]")
{
  const ScratchFolder folder;
  const auto          particles = postprocess_tests::numbered_particles(3);
  dem::Break          whole;
  whole.ends   = {0, 1};
  whole.mode   = dem::BreakMode::tension;
  whole.place  = {0.5, 0.25, 0.5};
  whole.area   = 0.3;
  auto element = whole, glue = whole;
  element.area /= 4;
  glue.ends[1] = -1;
  glue.surface = 0;
  CHECK(width_of(whole, 0.5) == Approx(0.6));
  CHECK(width_of(element, 0.5) == Approx(0.15));
  CHECK(width_of(element, 0) == Approx(0.5 * width_of(whole, 0)));
  const auto picture = [&](const dem::Break &b, const double thickness) {
    REQUIRE(picture_of_breaks(folder / "b.png", particles, {b}, thickness, "title") == "");
    return content_of(folder / "b.png");
  };
  CHECK(picture(element, 0.5) != picture(whole, 0.5));
  CHECK(picture(element, 0.125) == picture(whole, 0.5)); // as long, of thinner discs
  CHECK(picture(glue, 0.5) == picture(whole, 0.5));      // it has a second end that is no particle
}

TEST_CASE("a link to a periodic image shows no crack where only the cell lies between", "[postprocess]")
{
  const ScratchFolder folder;
  auto                particles = postprocess_tests::numbered_particles(3);
  dem::LinkOutput     link      = postprocess_tests::numbered_links(2);
  link.ends                     = {{0, 2}};
  link.damage                   = {0.5};
  link.kind                     = {dem::LinkOutput::cohesive};
  for (auto &u : particles.displacement)
    u.setZero();
  particles.displacement[2].x() = 1e-3; // away from the first, as with a cell that is stretched by as much
  particles.position[2].x() += 1e-3;
  const auto picture = [&](const std::string &name, const dem::LinkOutput &links, const PictureSlab &slab) {
    REQUIRE(picture_of_specimen(folder / name, particles, links, "title", slab) == "");
    return content_of(folder / name);
  };
  PictureSlab stretched, closed, opened;
  stretched.images        = {{{-3 - 1e-3, 0, 0}, {-3, 0, 0}}}; // the image has moved with the cell: as near as before
  opened.images           = {{{-3 - 3e-3, 0, 0}, {-3, 0, 0}}};
  const std::string whole = picture("none.png", {}, closed);
  CHECK(picture("across.png", link, closed) != whole); // as a reader without images sees it
  CHECK(picture("stretched.png", link, stretched) == whole);
  CHECK(picture("opened.png", link, opened) != whole);
}

TEST_CASE("materials are named in the legend", "[postprocess]")
{
  const ScratchFolder folder;
  auto                particles = postprocess_tests::numbered_particles(6);
  const auto          picture   = [&](const PictureSlab &slab) {
    REQUIRE(picture_of_specimen(folder / "p.png", particles, {}, "title", slab) == "");
    return content_of(folder / "p.png");
  };
  PictureSlab named, other;
  named.materials         = {"mortar", "aggregate"};
  other.materials         = {"mortar", "steel"};
  const std::string plain = picture({});
  CHECK(picture(named) == plain); // one material: nothing to distinguish
  particles.material = {0, 0, 1, 1, 0, 0};
  CHECK(picture(named) != picture(other));
  CHECK(picture(named) != plain);
}

TEST_CASE("a material of several numbers is one in colour and legend", "[postprocess]")
{
  const ScratchFolder folder;
  auto                particles = postprocess_tests::numbered_particles(6);
  const auto          picture = [&](const std::vector<std::int32_t> &material, const std::vector<std::string> &names) {
    PictureSlab slab;
    slab.materials     = names;
    particles.material = material;
    REQUIRE(picture_of_specimen(folder / "p.png", particles, {}, "title", slab) == "");
    return content_of(folder / "p.png");
  };
  const std::vector<std::int32_t> three = {0, 1, 2, 1, 0, 2}, two = {0, 1, 1, 1, 0, 1};
  CHECK(picture(three, {"mortar", "aggregate", "aggregate+2"}) == picture(two, {"mortar", "aggregate", "other"}));
  CHECK(picture(three, {"mortar", "aggregate", "steel+2"}) != picture(two, {"mortar", "aggregate", "other"}));
}

TEST_CASE("cracks of several classes of links have a colour and a line in the legend each", "[postprocess]")
{
  const ScratchFolder folder;
  const auto          particles = postprocess_tests::numbered_particles(6); // ever further apart
  dem::LinkOutput     links     = postprocess_tests::numbered_links(3);
  links.ends                    = {{0, 1}, {3, 4}};
  links.kind                    = {dem::LinkOutput::broken, dem::LinkOutput::broken};
  links.damage                  = {1, 1};
  const auto found              = [&](const std::vector<std::int32_t> &pairs, const std::vector<std::string> &classes) {
    PictureSlab slab;
    slab.classes = classes;
    links.pair   = pairs;
    REQUIRE(picture_of_specimen(folder / "p.png", particles, links, "title", slab) == "");
    return content_of(folder / "p.png");
  };
  const std::vector<std::string> mix  = {"mortar", "interface", "aggregate"};
  const std::string              both = found({0, 1}, mix);
  CHECK(both != found({0, 0}, mix));
  CHECK(both != found({0, 1}, {"mortar", "zone", "aggregate"}));
  CHECK(both == found({0, 3}, {"mortar", "interface", "aggregate", "interface"})); // by another number of the aggregate
  CHECK(found({0, 1}, {}) == found({0, 0}, {}));
}

TEST_CASE("lengths are drawn in the unit of their size, with ticks that have room for their labels", "[postprocess]")
{
  CHECK(std::string(length_unit(12).name) == "m");
  CHECK(std::string(length_unit(0.45).name) == "mm");
  CHECK(std::string(length_unit(1e-3).name) == "µm");
  CHECK(length_text(23.4e-6) == "23.4 µm");
  CHECK(length_text(1.5e-3) == "1.5 mm");
  CHECK(length_text(-11.7e-3) == "-11.7 mm");
  CHECK(tick_step(10, 5) == Approx(2));
  CHECK(tick_step(4.1, 3) == Approx(2));
  CHECK(tick_step(0.9, 8) == Approx(0.2));
  CHECK(round_magnification(47) == Approx(40));
  CHECK(round_magnification(2.5) == Approx(2));
  CHECK(round_magnification(0.3) == 1); // what moves far is drawn as it is
  CHECK(round_magnification(std::nan("")) == 1);

  // A pillar of 4 m by 12 m: ticks every 2 m, in metres.
  GnuplotJob   job;
  PictureFrame pillar{
    Eigen::AlignedBox2d(Eigen::Vector2d(-0.2, 0), Eigen::Vector2d(4.2, 12)), 'x', 'z', 760, 230, 150, 480};
  CHECK(std::string(set_axes(job, pillar).name) == "m");
  CHECK_THAT(job.script, Contains("set xtics 1\n") && Contains("x [m]") && Contains("z [m]"));
  // The same in steps that need more room: 0.4 m wide and 12 m high leave 25 pixels.
  pillar.box.max().x() = 0.2;
  job                  = {};
  set_axes(job, pillar);
  CHECK_THAT(job.script, Contains("set xtics 0.5\n"));
  // Its colour bar is as high as it; that of a beam 2 m long and 0.1 m high is higher than the beam: 200 of 480 pixels.
  CHECK(colour_bar(job, pillar).empty());
  pillar.box = Eigen::AlignedBox2d(Eigen::Vector2d(0, 0), Eigen::Vector2d(2, 0.1));
  job        = {};
  set_axes(job, pillar);
  CHECK(job.height == 480);
  CHECK_THAT(colour_bar(job, pillar), Contains("size screen 0.02,0.416667"));
  pillar.box.setEmpty();
  CHECK_THROWS_AS(set_axes(job, pillar), std::invalid_argument);
}

TEST_CASE("values are drawn in a unit that keeps numbers short, under a readable name", "[postprocess]")
{
  CHECK(drawn_unit(1.2e-4, "m").label == " [µm]");
  CHECK(drawn_unit(1.2e-4, "m").scale == Approx(1e6));
  CHECK(drawn_unit(-5200, "N").label == " [kN]");
  CHECK(drawn_unit(0, "N").label == " [N]");
  CHECK(drawn_unit(3e-6, "m^2").label == " [mm^2]");
  CHECK(drawn_unit(3e-6, "m^2").scale == Approx(1e6));
  CHECK(drawn_unit(4e-9, "m^3").label == " [mm^3]");
  CHECK(drawn_unit(4e-9, "m^3").scale == Approx(1e9));
  CHECK(drawn_unit(3, "-").label.empty());
  CHECK(readable("reaction_load_z") == "Reaction load z");
}

TEST_CASE("a picture of nothing is refused in words", "[postprocess]")
{
  const ScratchFolder folder;
  PictureSlab         elsewhere;
  elsewhere.position = 1e6;
  REQUIRE_THAT(picture_of_specimen(folder / "p.png", {}, {}, ""), Contains("there is no particle"));
  REQUIRE_THAT(picture_of_specimen(folder / "p.png", postprocess_tests::numbered_particles(3), {}, "", elsewhere),
               Contains("there is no particle in the slab"));
  REQUIRE(files_in(folder.path) == 0);
}

TEST_CASE("a field is drawn in the proportion of its facets, squares and triangles", "[postprocess]")
{
  const ScratchFolder       folder;
  std::vector<PictureFacet> facets(2);
  FieldPicture              what;
  facets[0].corner = {{{0, 0}, {0.4, 0}, {0.4, 0.1}, {0, 0.1}}};
  facets[1].corner = {{{0.4, 0}, {0.5, 0}, {0.4, 0.1}, {0.4, 0.1}}};
  facets[1].value  = 1;
  REQUIRE(picture_of_field(folder / "wide.png", facets, what).empty());
  for (PictureFacet &facet : facets)
    for (auto &corner : facet.corner)
      corner = {corner[1], corner[0]};
  REQUIRE(picture_of_field(folder / "high.png", facets, what).empty());
  CHECK(size_of_png(folder / "wide.png").first > size_of_png(folder / "wide.png").second);
  CHECK(size_of_png(folder / "high.png").first < size_of_png(folder / "high.png").second);

  CHECK_THAT(picture_of_field(folder / "none.png", {}, what),
             Contains("none.png: not drawn: there is nothing to draw"));
  facets[0].corner[2][0] = std::numeric_limits<double>::quiet_NaN();
  CHECK_THAT(picture_of_field(folder / "nan.png", facets, what), Contains("a corner is not a number"));
  CHECK_FALSE(std::filesystem::exists(folder / "nan.png"));
}
