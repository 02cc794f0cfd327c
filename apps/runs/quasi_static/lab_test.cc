#include "apps/runs/quasi_static/lab_test.h"

#include "apps/process/mpi_ranks.h"
#include "apps/results/snapshots.h"
#include "apps/results/warning.h"
#include "dem/observation/path_output.h"
#include "postprocess/pictures/specimen_picture.h"
#include "postprocess/vtk/vtk_links.h"
#include "postprocess/vtk/vtk_particles.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace apps
{
  namespace
  {
    /** An edge that is infinite, of a plane packing, or not there counts as 1 m: nothing repeats along it. */
    Eigen::Vector3d edges_of(const dem::Packing &packing)
    {
      const Eigen::Vector3d edges = packing.periodic_cell.value_or(Eigen::Vector3d::Ones());
      return edges.array().isFinite().select(edges, 1.0);
    }

    dem::QuasiStaticParameters on_ranks(dem::QuasiStaticParameters steps, dem::Ranks *const ranks)
    {
      steps.ranks = ranks;
      return steps;
    }
  } // namespace

  MaterialCounts materials_in(const dem::ElasticNetwork &network, const std::vector<std::string> &names)
  {
    std::vector<std::int32_t> pairs;
    for (const dem::ElasticLink &link : network.links)
      pairs.push_back(link.pair);
    return MaterialCounts(names, network.material, pairs);
  }

  void QuasiStaticResult::add(const dem::QuasiStaticPoint &point, const double e, const double s)
  {
    const double          sign    = load == UniaxialLoad::tension ? 1 : -1;
    dem::UniaxialFigures &figures = notes.figures;
    if (strain.empty() && point.mean_damage == 0)
      figures.young_modulus = s / e;
    if (sign * s > figures.strength)
      {
        figures.strength       = sign * s;
        figures.strain_at_peak = sign * e;
      }
    figures.peak_passed = dem::is_past_peak(figures, sign * e, sign * s, stop_fraction);
    worst_balance_error = std::max(worst_balance_error, point.balance_error());
    strain_points += point.control == dem::StepControl::strain;
    opening_points += point.control == dem::StepControl::opening;
    relaxed_points += point.control == dem::StepControl::relaxed;
    solutions += point.iterations;
    relaxation_steps += point.relaxation_steps;
    last = point;
    strain.push_back(e);
    stress.push_back(s);
  }

  void QuasiStaticResult::visit_state(base::StateVisitor &visitor)
  {
    notes.name = name_of(load);
    notes.visit_state(visitor);
    for (const auto &[name, value] :
         std::initializer_list<std::pair<const char *, double *>>{{"worst_balance_error", &worst_balance_error},
                                                                  {"external_work", &last.external_work},
                                                                  {"stored", &last.stored},
                                                                  {"damage", &last.damage},
                                                                  {"friction", &last.friction},
                                                                  {"damped", &last.damped},
                                                                  {"mean_damage", &last.mean_damage}})
      visitor.scalar(name, *value);
    for (const auto &[name, value] :
         std::initializer_list<std::pair<const char *, std::int64_t *>>{{"strain_points", &strain_points},
                                                                        {"opening_points", &opening_points},
                                                                        {"relaxed_points", &relaxed_points},
                                                                        {"solutions", &solutions},
                                                                        {"relaxation_steps", &relaxation_steps}})
      visitor.scalar(name, *value);
    visitor.column("strain", strain);
    visitor.column("stress", stress);
    visitor.column("link_classes", link_classes);
  }

  QuasiStaticLabTest::QuasiStaticLabTest(const QuasiStaticModel &model,
                                         const dem::Packing     &packing,
                                         const std::size_t       which)
    : QuasiStaticLabTest(model, model.jointed(packing), which)
  {
  }

  QuasiStaticLabTest::QuasiStaticLabTest(const QuasiStaticModel &model,
                                         const JointedPacking   &jointed,
                                         const std::size_t       which)
    : classes(jointed.link_classes(model.mixed().link_classes(jointed.packing().material_names)))
    , team(launched_team())
    , name(name_of(model.tests[which]))
    , axis(model.axis)
    , shape{model.dimension, 0, model.source.thickness}
    , end_strain(model.steps(model.tests[which]).end_strain)
    , snapshot_interval(model.snapshot_interval)
    , radius(jointed.packing().radius)
    , cell(edges_of(jointed.packing()))
    , loaded(model.load(jointed))
    , path(loaded, model.materials(jointed), on_ranks(model.steps(model.tests[which]), team.get()))
  {
    result.load          = model.tests[which];
    result.stop_fraction = model.steps(model.tests[which]).end_stress;
    result.notes.name    = name;
    if (model.mix.given())
      crack_classes = classes.of_pairs();
    if (!model.is_cell())
      {
        layers                    = model.grip_layers(jointed.packing());
        result.notes.section      = layers->section;
        result.notes.gauge_length = layers->gauge_length;
      }
    materials = materials_in(loaded.network, jointed.packing().material_names);
  }

  void QuasiStaticLabTest::open(const std::filesystem::path &folder)
  {
    if (snapshot_interval == 0)
      return;
    particles.emplace(folder, name + "_particles");
    links.emplace(folder, name + "_links");
  }

  void QuasiStaticLabTest::advance()
  {
    if (path.points().size() == 1 && particles)
      snapshot();
    const dem::QuasiStaticPoint &point = path.advance();
    result.add(point, gauged_strain(), point.stress[loaded.driven]);
    if (particles && static_cast<std::int64_t>(path.points().size() - 1) % snapshot_interval == 0)
      snapshot();
  }

  double QuasiStaticLabTest::gauged_strain() const
  {
    if (!layers || !layers->planes)
      return path.points().back().strain[loaded.driven];
    const std::vector<Eigen::Vector3d> u     = dem::displacements_of(loaded, path.motion());
    const auto                         place = [&](const std::size_t i) { return u[i][axis]; };
    return (layers->planes->second.motion(place) - layers->planes->first.motion(place)) / layers->gauge_length;
  }

  std::vector<postprocess::SeriesColumn> QuasiStaticLabTest::series_columns(const QuasiStaticModel &model)
  {
    std::vector<postprocess::SeriesColumn> all = {
      {"test", "", true}, {"point", ""}, {"strain", "-"}, {"stress", "Pa"}, {"mean_damage", "-"}};
    if (model.is_cell())
      for (const char *strain : {"strain_xx", "strain_yy", "strain_zz"})
        all.push_back({strain, "-"});
    for (const char *energy :
         {"energy_work", "energy_stored", "energy_damage", "energy_friction", "energy_damped", "energy_residual"})
      all.push_back({energy, "J"});
    for (const auto &last : {postprocess::SeriesColumn{"unbalanced", "-"},
                             {"solutions", ""},
                             {"relaxation_steps", ""},
                             {"control", "", true}})
      all.push_back(last);
    return all;
  }

  SeriesRow QuasiStaticLabTest::row() const
  {
    const dem::QuasiStaticPoint &p      = path.points().back();
    std::vector<double>          values = {static_cast<double>(path.points().size() - 1), result.strain.back(),
                                           p.stress[loaded.driven], p.mean_damage};
    if (!layers)
      values.insert(values.end(), p.strain.data(), p.strain.data() + 3);
    values.insert(values.end(),
                  {p.external_work, p.stored, p.damage, p.friction, p.damped, p.energy_residual(), p.residual,
                   static_cast<double>(p.iterations), static_cast<double>(p.relaxation_steps)});
    return {{name}, values, {dem::name_of(p.control)}};
  }

  void QuasiStaticLabTest::visit_state(RunState &state)
  {
    state.group("path");
    path.visit_state(state);
    visit_snapshots(state, "particle_snapshots", particles);
    visit_snapshots(state, "link_snapshots", links);
  }

  std::vector<dem::LinkImage> QuasiStaticLabTest::images_of(const dem::LinkOutput     &joined,
                                                            const dem::ParticleOutput &state) const
  {
    if (!loaded.network.periodic())
      return {};
    const auto     &e = path.points().back().strain; // engineering shears, 11 22 33 23 31 12
    Eigen::Matrix3d strain;
    strain << e[0], e[5] / 2, e[4] / 2, e[5] / 2, e[1], e[3] / 2, e[4] / 2, e[3] / 2, e[2];
    const Eigen::Matrix3d base = cell.asDiagonal();
    return dem::link_images(joined, state, base + strain * base, base);
  }

  void QuasiStaticLabTest::snapshot()
  {
    // ParaView's time is the number of the point: strain may fall.
    const auto                at    = static_cast<double>(path.points().size() - 1);
    const dem::ParticleOutput state = dem::particles_of(loaded, path, radius, shape);
    postprocess::write_vtk_particles(particles->next(), state, at);
    particles->add(at);
    const dem::LinkOutput joined = dem::links_of(loaded, path);
    postprocess::write_vtk_links(links->next(), joined, state, at, images_of(joined, state), classes.of_links(joined));
    links->add(at);
  }

  void QuasiStaticLabTest::complete()
  {
    if (particles && static_cast<std::int64_t>(path.points().size() - 1) % snapshot_interval != 0)
      snapshot();
    const dem::LinkOutput joined = dem::links_of(loaded, path);
    result.notes.crack           = dem::measure_crack(dem::particles_of(loaded, path, radius, shape), joined, shape);
    result.link_classes          = classes.figures(joined, loaded.network);
    dem::CurveFigures curve;
    for (std::size_t i = 0; i < result.strain.size(); ++i)
      curve.add(result.strain[i], result.stress[i]);
    note_work_of_fracture(result.notes, curve.figures());
  }

  std::string QuasiStaticLabTest::size() const
  {
    return fmt::format("{} particles, {} links", particles_in(), links_in());
  }

  std::string QuasiStaticLabTest::draw_crack(const std::filesystem::path &folder) const
  {
    const dem::ParticleOutput state  = dem::particles_of(loaded, path, radius, shape);
    const dem::LinkOutput     joined = dem::links_of(loaded, path);
    postprocess::PictureSlab  slab;
    slab.axis      = axis == 2 ? 1 : 2; // seen across the load
    slab.materials = materials.names;
    slab.classes   = crack_classes;
    slab.images    = images_of(joined, state);
    return postprocess::picture_of_specimen(folder / (name + "_crack.png"), state, joined, "After " + name, slab);
  }

  double QuasiStaticLabTest::done() const
  {
    return std::min(1.0, std::fabs(path.points().back().strain[loaded.driven]) / end_strain);
  }

  std::string QuasiStaticLabTest::details() const
  {
    const dem::QuasiStaticPoint &p = path.points().back();
    return fmt::format("point {}, strain {:.2e}, stress {:.3g} MPa, {}", path.points().size() - 1,
                       p.strain[loaded.driven], 1e-6 * p.stress[loaded.driven], dem::name_of(p.control));
  }
} // namespace apps
