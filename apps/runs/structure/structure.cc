#include "apps/runs/structure/structure.h"

#include "apps/figures/drawn_curve.h"
#include "apps/process/mpi_ranks.h"
#include "apps/runs/quasi_static/lab_test.h"
#include "base/errors.h"

#include <fmt/format.h>

#include <algorithm>

namespace apps
{
  namespace
  {
    /** Whether the load factor is one of forces: without a place that it moves, nothing would be released with it. */
    bool drives_by_force(const LoadsSection &loads)
    {
      return any_given(loads.body_force) || !loads.forces.empty() ||
             std::any_of(loads.boundaries.begin(), loads.boundaries.end(),
                         [](const auto &b) { return any_given(b->traction) || b->pressure.given(); });
    }
  } // namespace

  Structure::Structure(const StructureModel &what, const StructureParts &parts, const ParticleMedia &media)
    : model(what)
    , handshakes(parts.handshakes)
    , groups(parts.groups)
    , promoted_elements(parts.promoted)
    , radius(parts.packing.radius)
    , solid(make_solid(parts.packing, media))
    , alone(solid ? std::nullopt : std::optional(particles_alone(parts.packing)))
    , materials(materials_in(network().network, parts.packing.material_names))
    , team(launched_team())
    , path(network(), what.materials(parts.packing), parameters())
  {
    refuse_many_weightless();
    refuse_soft_elements();
    if (network().dead && !parts.bears_weight)
      weight_path = std::make_unique<WeightPath>(network(), what.materials(parts.packing), parameters(),
                                                 !drives_by_force(what.continuum.loads));
    for (const auto &[test, evaluated] : {std::pair{"Bending test", model.bending_test.evaluate()},
                                          std::pair{"Wedge splitting", model.wedge_splitting.evaluate()}})
      if (const std::string load = curve().second; evaluated && load.rfind("reaction_", 0) != 0)
        throw base::InputError(std::string(test) + ": its load is Output/Curve vertical, here " + load +
                               ": expected a reaction, reaction_load_z say.");
  }

  dem::QuasiStaticParameters Structure::parameters() const
  {
    dem::QuasiStaticParameters p = model.path.parameters(team.get());
    if (const DisplacementProbe *probe = model.probes.find(model.path.leading))
      p.leading = {groups.at(probe->group), probe->other.empty() ? std::vector<std::size_t>() : groups.at(probe->other),
                   probe->axis, model.path.opening_step, model.path.end_opening};
    return p;
  }

  void Structure::advance()
  {
    if (bears_weight())
      {
        path.advance();
        return;
      }
    weight_path->advance();
    if (!weight_path->way().finished())
      return;
    path.go_on_where(weight_path->way());
    weight_path.reset();
  }

  void Structure::visit_path(RunState &state)
  {
    state.group("path");
    if (network().dead)
      {
        std::int64_t on = bears_weight() ? 1 : 0;
        state.scalar("weight_is_on", on);
        if (state.reads() && on == 1)
          weight_path.reset();
      }
    way().visit_state(state);
  }

  double Structure::load_factor() const { return bears_weight() ? path.driven_since_start() : 0.0; }

  Eigen::Vector3d Structure::weight() const
  {
    if (!network().dead)
      return Eigen::Vector3d::Zero();
    const auto            particles = static_cast<Eigen::Index>(network().network.particles());
    const Eigen::Vector3d sum       = network().dead->force.topLeftCorner(3, particles).rowwise().sum();
    return solid ? Eigen::Vector3d(sum + solid->weight()) : sum;
  }

  double Structure::work_of_weight() const
  {
    // While it is put on nothing else works; then it goes on by itself, but for what the change of a network puts elsewhere.
    const int   part   = network().dead->parameter;
    double      work   = 0;
    const auto &points = way().points();
    for (std::size_t i = 1; i < points.size(); ++i)
      if (points[i].strain[part] != points[i - 1].strain[part])
        work += points[i].external_work - points[i - 1].external_work;
      else if (points[i].control != dem::StepControl::changed)
        work -= (points[i].stress[part] - points[i - 1].stress[part]) * network().volume;
    return work;
  }

  dem::LoadedNetwork Structure::particles_alone(const dem::Packing &packing)
  {
    dem::LoadedNetwork loaded = model.particles(packing, groups);
    if (loaded.dead)
      swinging = dem::unload_hinges(loaded);
    return loaded;
  }

  void Structure::refuse_many_weightless() const
  {
    constexpr double at_most = 0.01;
    if (static_cast<double>(weightless().size()) > at_most * static_cast<double>(network().network.particles()))
      throw base::InputError("Gravity: " + dem::describe(weightless()) +
                             " Raise the interaction ratio, or take them out of the packing.");
  }

  void Structure::refuse_soft_elements() const
  {
    // Once elements have become particles, those that are left are as stiff as they were.
    const bool at_start =
      std::all_of(promoted_elements.begin(), promoted_elements.end(), [](auto n) { return n == 0; });
    if (solid && at_start && !solid->is_positive())
      throw base::InputError("Handshakes: some motions of the overlap would cost no energy. With Method = constrained, "
                             "what bonds bear within elements is taken off "
                             "the stiffness of these, which are too soft or too small for it. Let elements be stiffer "
                             "or larger, or the region end elsewhere "
                             "between its particles, or set Method = multipliers.");
  }

  std::unique_ptr<StructureSolid> Structure::make_solid(const dem::Packing &packing, const ParticleMedia &media) const
  {
    if (!model.has_solid())
      return nullptr;
    give_media(model.continuum.materials, media);
    return surround(model, handshakes, model.particles(packing, groups));
  }

  std::string Structure::size() const
  {
    std::string text =
      fmt::format("{} particles, {} links", network().network.particles(), network().network.links.size());
    if (solid)
      text += fmt::format(", {} elements", solid->elements());
    return text;
  }

  dem::ParticleOutput Structure::particle_output() const
  {
    return dem::particles_of(network(), way(), radius, model.shape());
  }

  std::vector<postprocess::SeriesColumn> Structure::reported() const
  {
    std::vector<postprocess::SeriesColumn> all = model.probes.columns();
    for (const ParticleSupport &support : model.supports.supports)
      for (int c = 0; c < model.dimension; ++c)
        if (support.drives(c))
          all.push_back({"reaction_" + column_name(support.group) + "_" + "xyz"[c], "N"});
    if (!solid)
      return all;
    for (const ProbeColumn &probe : solid->columns())
      {
        all.push_back(probe.column);
        if (const std::string energy = "energy_"; all.back().name.rfind(energy, 0) == 0)
          all.back().name.insert(energy.size(), "solid_");
      }
    return all;
  }

  std::vector<postprocess::SeriesColumn> Structure::columns() const
  {
    std::vector<postprocess::SeriesColumn> all = {{"point", ""}, {"load_factor", "-"}, {"force_of_load_factor", "J"}};
    if (network().dead)
      all.push_back({"weight", "-"});
    for (const postprocess::SeriesColumn &one : reported())
      all.push_back(one);
    all.push_back({"mean_damage", "-"});
    for (const HandshakeSection &handshake : handshakes.handshakes)
      all.push_back({column_name(handshake.name) + "_damaged", ""});
    if (handshakes.promote())
      for (const HandshakeSection &handshake : handshakes.handshakes)
        all.push_back({column_name(handshake.name) + "_promoted", ""});
    for (const char *term : {"work", "stored", "damage", "friction", "damped", "residual"})
      all.push_back({std::string("energy_") + term, "J"});
    if (handshakes.promote())
      all.push_back({"energy_promoted", "J"});
    if (network().dead)
      all.push_back({"energy_weight", "J"});
    for (const auto &end : {postprocess::SeriesColumn{"unbalanced", "-"},
                            {"solutions", ""},
                            {"relaxation_steps", ""},
                            {"control", "", true}})
      all.push_back(end);
    return all;
  }

  std::pair<std::string, std::string> Structure::curve() const
  {
    std::vector<std::string> names;
    std::string              reaction = "force_of_load_factor";
    for (const postprocess::SeriesColumn &column : columns())
      {
        names.push_back(column.name);
        if (column.name.rfind("reaction_", 0) == 0 && reaction.rfind("reaction_", 0) != 0)
          reaction = column.name;
      }
    std::sort(names.begin(), names.end());
    if (const auto twice = std::adjacent_find(names.begin(), names.end()); twice != names.end())
      throw base::InputError("column " + *twice +
                             " of series.csv would be there twice. Name a probe or a group otherwise.");
    const auto probes = model.probes.columns();
    return {
      chosen_column(names, "Curve horizontal", model.horizontal, probes.empty() ? "load_factor" : probes.front().name),
      chosen_column(names, "Curve vertical", model.vertical, reaction)};
  }

  std::vector<double> Structure::reactions() const
  {
    const auto                  &links = network().network.links;
    const auto                  &force = way().links().forces();
    std::vector<Eigen::Vector3d> on(network().network.particles(), Eigen::Vector3d::Zero());
    for (std::size_t l = 0; l < links.size(); ++l)
      {
        on[links[l].first] += force[l];
        on[links[l].second] -= force[l];
      }
    if (const auto &dead = network().dead)
      for (std::size_t i = 0; i < on.size(); ++i)
        on[i] += last().strain[dead->parameter] * dead->force.col(static_cast<Eigen::Index>(i)).head<3>();
    std::vector<double> values;
    for (const ParticleSupport &support : model.supports.supports)
      for (int c = 0; c < model.dimension; ++c)
        if (support.drives(c))
          {
            double sum = 0;
            for (const std::size_t i : groups.at(support.group))
              sum -= on[i][c];
            values.push_back(sum);
          }
    return values;
  }

  std::vector<std::pair<std::size_t, std::size_t>> Structure::shared_bonds() const
  {
    std::vector<std::pair<std::size_t, std::size_t>> counted;
    if (solid)
      for (const std::vector<std::size_t> &links : solid->shared_links())
        counted.emplace_back(links.size(), std::count_if(links.begin(), links.end(), [this](const std::size_t l) {
                               return way().links().damage_of(l).stiffness > 0 ||
                                      way().links().damage_of(l).strength > 0;
                             }));
    return counted;
  }

  SeriesRow Structure::row() const
  {
    const dem::QuasiStaticPoint &p      = last();
    std::vector<double>          values = {static_cast<double>(way().points().size() - 1), load_factor(),
                                           p.stress[network().driven] * network().volume};
    const auto add = [&](const std::vector<double> &more) { values.insert(values.end(), more.begin(), more.end()); };
    if (network().dead)
      add({p.strain[network().dead->parameter]});
    add(model.probes.read(dem::displacements_of(network(), way().motion()), groups));
    add(reactions());
    if (solid)
      add(solid->read(way().motion()));
    add({p.mean_damage});
    for (const auto &[all, damaged] : shared_bonds())
      add({static_cast<double>(damaged)});
    if (handshakes.promote())
      add({promoted_elements.begin(), promoted_elements.end()});
    add({p.external_work, p.stored, p.damage, p.friction, p.damped, p.energy_residual()});
    if (handshakes.promote())
      add({p.changed});
    if (network().dead)
      add({work_of_weight()});
    add({p.residual, static_cast<double>(p.iterations), static_cast<double>(p.relaxation_steps)});
    return {{}, values, {dem::name_of(p.control)}};
  }

  void Structure::watch() const
  {
    const auto counted   = shared_bonds();
    auto       handshake = handshakes.handshakes.begin();
    for (const auto &[all, damaged] : counted)
      {
        if (static_cast<double>(damaged) > handshake->damage_limit * static_cast<double>(all))
          throw StoppedShort(
            fmt::format("Handshakes/{}: at the load factor {:.6g} {} of the {} bonds in the overlap are damaged, more "
                        "than Damage limit = {}: there the solid cannot follow. Give the particles a larger {}.",
                        handshake->name, load_factor(), damaged, all, handshake->damage_limit,
                        handshake->promotes() ? "Promotion reach" : "region"));
        ++handshake;
      }
  }
} // namespace apps
