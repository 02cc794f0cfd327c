#include "apps/drivers/sequential/scene.h"

#include "apps/drivers/continuum/expected_duration.h"
#include "apps/drivers/sequential/law_identification.h"
#include "apps/drivers/sequential/outline.h"
#include "apps/drivers/sequential/particle_case.h"
#include "apps/drivers/sequential/run.h"
#include "apps/forecasts/duration.h"
#include "apps/specimens/packing_extents.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace apps
{
  double SequentialModel::tensile_strength() const
  {
    double least = std::numeric_limits<double>::max();
    for (const MaterialOfGroup *group : receivers())
      least = std::min(least, group->chosen().constants->uniaxial_strengths().tension);
    return least;
  }

  std::vector<const MaterialOfGroup *> SequentialModel::receivers() const
  {
    std::vector<const MaterialOfGroup *> found;
    for (const auto &group : continuum.materials.groups)
      if (group->law->takes_initial_state())
        found.push_back(group.get());
    return found;
  }

  namespace
  {
    std::string names_of_receiving_laws()
    {
      std::string names;
      for (const auto &kind : fem::material_kinds())
        if (kind->takes_initial_state())
          names += (names.empty() ? "" : " or ") + kind->name();
      return names;
    }
  } // namespace

  void SequentialScene::declare(Section &scene)
  {
    root                         = &scene;
    model.particles.strained_too = [this] { return model.transfer.identifies(); };
    model.particles.declare(scene);
    model.transfer.declare(scene);
    model.identification.declare(*scene.find_section("Transfer"), model.transfer);
    Section &continuum =
      scene.section("Continuum", "The solid that carries on; the sections of a scene of kind continuum");
    model.continuum.declare(continuum);
    Section &s = scene.section("Study", "How the continuations are read and compared");
    s.number("Length", model.study.length, "m", Range::positive(), Need::optional)
      .means("Displacement over it is the strain of the continuation; 1: displacements as they are")
      .housekeeping();
    s.number("Area", model.study.area, "m^2", Range::positive(), Need::optional)
      .means("Force over it is the stress; 1: forces as they are")
      .housekeeping();
    s.number("Sign", model.study.sign, "-", Range::between(-1, 1), Need::optional)
      .means("-1 turns both around")
      .housekeeping();
    s.number("Least force", model.study.least_force, "-", Range::from_up_to(0, 1), Need::optional)
      .means(
        "A continuation of which every point softens, in ten steps in a row, ends when no more than this part of its "
        "largest force (Output/Curve vertical) is left; 0: it goes on");
    s.text("Horizontal", model.study.horizontal, Need::required)
      .means("Column of the continuation's series.csv")
      .housekeeping();
    s.text("Vertical", model.study.vertical, Need::required)
      .means("Column of the continuation's series.csv")
      .housekeeping();
  }

  void SequentialScene::check() const
  {
    const base::EntryPath scene;
    model.particles.check(scene);
    model.transfer.check(scene);
    if (model.transfer.identifies() && model.particles.source == ParticleEventSection::Source::file)
      scene.at("Transfer")
        .at("Mapping law")
        .refuse(
          "Law",
          "saved states do not say what their particles are made of. Identify the law with the scene that made them "
          "(breccia transfer --identify), and give its constants: Law = own.");
    const base::EntryPath continuum = scene.at("Continuum");
    model.continuum.check(continuum);
    if (!model.continuum.is_static())
      continuum.at("Model").refuse("Analysis", "a transferred state is carried on in equilibrium: static.");
    if (model.particles.source != ParticleEventSection::Source::file &&
        model.particles.physics.dimension != model.continuum.solid.dimension)
      continuum.at("Model").refuse("Dimension", "must be that of the particles (Particles/Physics/Dimension).");
    if (model.study.sign != 1 && model.study.sign != -1)
      scene.at("Study").refuse("Sign", "must be 1 or -1.");
    if (model.receivers().empty())
      continuum.at("Materials")
        .refuse("Law",
                "at least one group must be " + names_of_receiving_laws() + ", or there is nothing to transfer to.");
  }

  SequentialGroundwork SequentialScene::groundwork() const
  {
    SequentialGroundwork found;
    const SolidOutline   solid = outline_of(model.continuum); // before the packing, which may take long
    found.packing              = event_packing(model.particles);
    const Section   &study     = *root->find_section("Study");
    const StudyUnits units     = check_study(model, study, solid, outlines_of(model, found.packing));
    found.element_size         = solid.mean_element_size(model.continuum.solid.dimension);
    found.elements             = solid.elements;
    found.unknowns             = solid.unknowns;
    found.horizontal_unit      = units.horizontal;
    found.vertical_unit        = units.vertical;

    using Source = ParticleEventSection::Source;
    if (model.particles.source == Source::uniaxial)
      found.origin.test = model.particles.compresses() ? "compression" : "tension";
    if (model.particles.source != Source::file)
      found.origin.particles = digest_of_particles(*root->find_section("Particles"));
    const Section &materials = *root->find_section("Continuum")->find_section("Materials");
    for (const MaterialOfGroup *group : model.receivers())
      {
        const std::string digest =
          digest_of_material(*materials.find_section(group->group)->find_section(group->law->name()), *group->law);
        if (found.origin.continuum.empty())
          {
            found.origin.material  = group->law->name();
            found.origin.continuum = digest;
          }
        else if (found.origin.continuum != digest)
          found.doubts.push_back("the groups of elements are of several materials, and the mapping law is one: \"" +
                                 group->group + "\" differs from the first.");
      }
    if (const std::string doubt = doubt_about_law(model.transfer, found.origin); !doubt.empty())
      found.doubts.push_back(doubt);
    return found;
  }

  namespace
  {
    double seconds_of_particles(const ParticleEventSection &event, const dem::Packing &packing)
    {
      double seconds = 0;
      for (std::size_t k = 0; k < event.cases(); ++k)
        seconds += expected_seconds(*make_particle_case(event, packing, k));
      if (const auto reference = make_reference_case(event, packing))
        seconds += expected_seconds(*reference);
      return seconds;
    }

    /** One continuation, which begins in the virgin solid here. */
    template <int dim>
    double seconds_of_continuation(const ContinuumModel &model)
    {
      ContinuumRun<dim> run(RunRequest{}, model);
      return expected(run, model, states_of(run.body(), model)).seconds;
    }
  } // namespace

  std::string SequentialScene::forecast() const
  {
    const base::Stopwatch      set_up;
    const SequentialGroundwork ground         = groundwork();
    const double               set_up_seconds = set_up.seconds();
    std::string text = fmt::format("  transfers    {}\n  elements     {}\n  unknowns     {}\n", model.particles.cases(),
                                   ground.elements, ground.unknowns);
    const auto  first = make_particle_case(model.particles, ground.packing, 0);
    if (const dem::Specimen *body = first->body())
      text += fmt::format("  particles    {}\n  links        {}\n  time step    {:.4g} s\n", body->counts().particles,
                          body->counts().links, body->time_step());
    if (ground.packing.size() > 0)
      text += extent_lines(ground.packing, model.particles.physics.dimension);
    if (const StaticStart start = first->settle())
      text += fmt::format("  start        {}\n", text_of(*start));
    for (const std::string &doubt : ground.doubts)
      text += fmt::format("  warning      {}\n", doubt);
    double seconds = set_up_seconds + seconds_of_particles(model.particles, ground.packing);
    if (model.transfer.identifies())
      seconds += LawIdentification(model, ground.origin, ground.element_size).expected_seconds(ground.packing);
    try
      {
        seconds += static_cast<double>(model.particles.cases()) * (model.continuum.solid.dimension == 2 ?
                                                                     seconds_of_continuation<2>(model.continuum) :
                                                                     seconds_of_continuation<3>(model.continuum));
      }
    catch (const std::runtime_error &failure)
      {
        return text + fmt::format("  warning      the first step of an undamaged solid fails: {}\n", failure.what());
      }
    return text + duration_line(seconds);
  }

  RunResult SequentialScene::run(const RunRequest &request) const
  {
    return SequentialRun(model, groundwork(), request).carry_on();
  }

  RunResult SequentialScene::transfer_only(const RunRequest &request) const
  {
    return SequentialRun(model, groundwork(), request).transfer_only();
  }

  RunResult SequentialScene::identify(const RunRequest &request) const
  {
    return SequentialRun(model, groundwork(), request).identify_only();
  }
} // namespace apps
