// Section "Particles" of a sequential scene: what its words mean, and what makes no sense; and the origin of a mapping law.
#include "apps/runs/sequential/law_origin.h"
#include "apps/runs/sequential/particle_event.h"
#include "apps/runs/sequential/transfer_section.h"
#include "apps/scene/overrides.h"
#include "apps/scene/reader.h"
#include "apps/scene/section.h"
#include "apps/scene/sequential/particle_event.h"
#include "tests/apps/program.h"
#include "tests/apps/scratch_folder.h"
#include "tests/places.h"

#include <catch2/catch.hpp>

using namespace apps_tests;
using Catch::Contains;

namespace
{
  using Instants = std::vector<apps::ParticleEventSection::Instant>;

  apps::ParticleEventSection uniaxial(const Instants &instants)
  {
    apps::ParticleEventSection event;
    event.strain_rate = 2;
    event.instants    = instants;
    return event;
  }

  /** Instants as a scene writes them, and what is wrong with them. */
  std::pair<Instants, std::string> read_instants(const std::string &text)
  {
    apps::Section              root;
    apps::ParticleEventSection event;
    declare(root, event);
    const auto *entry = root.find_section("Particles")->find_section("Uniaxial")->find_entry("Instants");
    std::string wrong = entry->store(text, {});
    return {event.instants, wrong};
  }

  /** What is refused of a beam or specimen whose other entries are right. */
  std::string refusal(const std::vector<std::string> &entries)
  {
    apps::Section              root;
    apps::ParticleEventSection event;
    declare(root, event);
    std::vector<std::string> all = {"Particles/Specimen/Source=generator",
                                    "Particles/Specimen/Generator/Particle radius=1e-3",
                                    "Particles/Specimen/Box size=0.02, 0.02, 0.02",
                                    "Particles/Specimen/Density=2500",
                                    "Particles/Specimen/Interaction ratio=1.5",
                                    "Particles/Material/Law=linear",
                                    "Particles/Material/linear/Effective modulus=1e7"};
    all.insert(all.end(), entries.begin(), entries.end());
    try
      {
        assign(root, apps::read_overrides(all), "test");
        event.check({});
      }
    catch (const base::InputError &refused)
      {
        return refused.what();
      }
    return "";
  }

  apps::TransferSection own_law(const std::string &identified_for)
  {
    apps::TransferSection transfer;
    transfer.law            = "own";
    transfer.identified_for = identified_for;
    return transfer;
  }

  const std::string a(16, 'a'), b(16, 'b'), c(16, 'c');
} // namespace

TEST_CASE("Instants are strains, or strains and those unloaded to", "[apps][transfer]")
{
  const Instants read = read_instants("-1e-3, -2e-3 > -1.5e-3").first;
  REQUIRE(read.size() == 2);
  CHECK(read[0].forward == -1e-3);
  CHECK_FALSE(read[0].back);
  CHECK(read[1].forward == -2e-3);
  CHECK(*read[1].back == -1.5e-3);
  CHECK(uniaxial({{-1e-3, {}}}).compresses());
  CHECK_FALSE(uniaxial({{1e-3, {}}}).compresses());
  CHECK(uniaxial(read).cases() == 2);
  for (const char *nonsense : {"deep", "-1e-3 >", "-1e-3, , x"})
    {
      CAPTURE(nonsense);
      CHECK_THAT(read_instants(nonsense).second, Contains("expected strains"));
    }
  for (const char *impossible : {"0", "-1e-3 > -2e-3"}) // driven back further than it went
    {
      CAPTURE(impossible);
      CHECK_THAT(
        refusal({"Particles/Source=uniaxial", "Particles/Uniaxial/Strain rate=1",
                 "Particles/Uniaxial/Grip thickness=2.2e-3", std::string("Particles/Uniaxial/Instants=") + impossible}),
        Contains("Instants") && Contains("expected strains"));
    }
}

TEST_CASE("The specimen of an event is strained towards its instants, and an impactor is no part of the beam",
          "[apps][transfer]")
{
  CHECK(apps::uniaxial_parameters(uniaxial({{-1e-3, {}}}), -1e-3).strain_rate == -2);
  CHECK(apps::uniaxial_parameters(uniaxial({{1e-3, {}}}), 1e-3).strain_rate == 2);
  apps::ParticleEventSection event = uniaxial({{1e-3, {}}});
  CHECK(event.specimen_parameters().loose == 0);
  event.source     = apps::ParticleEventSection::Source::impact;
  event.velocities = {1, 2.5, 4};
  CHECK(event.specimen_parameters().loose == 1);
  CHECK(event.cases() == 3);
}

TEST_CASE("Instants of two signs, an end beyond nothing and speeds of nothing are refused at their entry",
          "[apps][transfer][S14]")
{
  const std::string              u = "Particles/Uniaxial/", i = "Particles/Impact/";
  const std::vector<std::string> pulled = {"Particles/Source=uniaxial", u + "Strain rate=1",
                                           u + "Grip thickness=2.2e-3"};
  const auto                     with   = [&](std::vector<std::string> more) {
    more.insert(more.begin(), pulled.begin(), pulled.end());
    return refusal(more);
  };
  CHECK(with({u + "Instants=1e-3, 2e-3"}) == "");
  CHECK_THAT(with({u + "Instants=1e-3, -2e-3"}), Contains("Instants") && Contains("one sign"));
  CHECK_THAT(with({u + "Instants=1e-3", u + "End strain=-1e-2"}), Contains("End strain") && Contains("the sign"));
  CHECK_THAT(with({u + "Instants=soon"}), Contains("Instants") && Contains("expected strains"));
  CHECK_THAT(refusal({"Particles/Source=impact", i + "Span=0.1", i + "Support width=0.01", i + "Impactor radius=0.01",
                      i + "Impactor velocities=0", i + "Longest time=1"}),
             Contains("Impactor velocities") && Contains("above 0"));
}

TEST_CASE("The origin of a mapping law is read as it was written, also with the name that a continuum had before",
          "[apps][transfer]")
{
  const apps::LawOrigin origin{"compression", a, "damage-plastic concrete", b};
  CHECK(origin.text() == "compression, particles " + a + ", damage-plastic concrete " + b);
  const auto read = apps::LawOrigin::read(origin.text());
  REQUIRE(read);
  CHECK(read->text() == origin.text());
  const auto earlier = apps::LawOrigin::read("tension, particles " + a + ", concrete " + b);
  REQUIRE(earlier);
  CHECK(earlier->material == "concrete");
  CHECK(earlier->continuum == b);
  for (const std::string &no_such : {std::string("my particles"), "torsion, particles " + a + ", concrete " + b,
                                     "tension, particles " + a + ", " + b, "tension, particles aa, concrete " + b})
    {
      CAPTURE(no_such);
      CHECK_FALSE(apps::LawOrigin::read(no_such));
    }
}

TEST_CASE("A mapping law is doubted where particles, continuum or test are not those that it was found for",
          "[apps][transfer]")
{
  const apps::LawOrigin here{"compression", a, "damage-plastic concrete", b};
  const auto doubt = [&here](const std::string &found_for) { return doubt_about_law(own_law(found_for), here); };
  CHECK(doubt(here.text()) == "");
  CHECK(doubt("compression, particles " + a + ", concrete " + b) == ""); // the digest decides, not the name
  CHECK_THAT(doubt("compression, particles " + c + ", damage-plastic concrete " + b), Contains("other particles"));
  CHECK_THAT(doubt("compression, particles " + a + ", damage-plastic concrete " + c),
             Contains("another damage-plastic concrete"));
  CHECK_THAT(doubt("tension, particles " + a + ", damage-plastic concrete " + b),
             Contains("identified in tension") && Contains("under compression"));
  CHECK_THAT(doubt(""), Contains("Identified for"));
  apps::TransferSection published;
  CHECK_THAT(doubt_about_law(published, here), Contains("\"default\"") && Contains("Law = identify"));
  published.law = "identify";
  CHECK(doubt_about_law(published, here) == "");
  apps::LawOrigin from_files = here;
  from_files.particles       = "";
  CHECK_THAT(doubt_about_law(own_law(here.text()), from_files), Contains("the particles come from files"));
}

TEST_CASE("check of an impact counts the impactor, and every link of the beam", "[apps][slow]")
{
  const ScratchFolder folder;
  std::string         packing = "x y z radius\n"; // simple cubic, 2.02 mm apart: 20 x 4 x 4
  for (int i = 0; i < 20; ++i)
    for (int j = 0; j < 4; ++j)
      for (int k = 0; k < 4; ++k)
        packing += std::to_string(0.001 + 0.00202 * i) + " " + std::to_string(0.001 + 0.00202 * j) + " " +
                   std::to_string(0.001 + 0.00202 * k) + " 0.001\n";
  folder.file("packing.txt", packing);
  const Outcome outcome = run(
    folder.path(),
    {"check", places::sources() + "/apps/scenes/impact_beam.prm", "-s", "Particles/Specimen/Source=file", "-s",
     "Particles/Specimen/File=" + (folder / "packing.txt").string(), "-s", "Particles/Impact/Span=0.03", "-s",
     "Particles/Impact/Support width=0.004", "-s", "Transfer/Limits/Extents=10"}); // the mesh is that of a longer beam
  INFO(outcome.err);
  REQUIRE(outcome.status == 0);
  // Within 1.5 diameters lie the neighbours along the edges (784 pairs) and across the faces (1272) of the lattice's cubes.
  CHECK_THAT(outcome.out, Contains("particles    321\n") && Contains("links        2056\n"));
}
