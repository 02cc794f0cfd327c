#include "apps/runs/sequential/outline.h"

#include "apps/process/mpi_session.h"
#include "apps/runs/continuum/probes.h"
#include "apps/runs/continuum/run.h"
#include "apps/text/nearest_name.h"
#include "fem/mesh/extent.h"
#include "postprocess/hdf5/discrete_state_hdf5.h"

#include <deal.II/grid/grid_tools.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace apps
{
  namespace
  {
    template <int dim>
    SolidOutline outline(const ContinuumModel &model)
    {
      const ContinuumRun<dim> run(RunRequest{}, model); // refuses what a run would refuse
      const fem::Solid<dim>  &solid = run.body();
      const fem::Extent<dim>  box   = fem::extent_of(solid.mesh());
      SolidOutline            found;
      for (int d = 0; d < dim; ++d)
        {
          found.low[d]  = box.low[static_cast<unsigned int>(d)];
          found.high[d] = box.high[static_cast<unsigned int>(d)];
        }
      found.volume =
        dealii::GridTools::volume(*solid.mesh().triangulation, solid.mapping()) * solid.options().thickness;
      found.elements = solid.mesh().triangulation->n_global_active_cells();
      found.unknowns = solid.dofs().n_dofs();
      found.columns  = run.series_columns();
      return found;
    }

    /** Grows with every sphere. */
    void include(ParticleOutline &outline, const Eigen::Vector3d &centre, const double radius)
    {
      outline.low  = outline.low.cwiseMin((centre.array() - radius).matrix());
      outline.high = outline.high.cwiseMax((centre.array() + radius).matrix());
      outline.mean_radius += radius;
    }

    ParticleOutline empty_outline(const std::string &origin)
    {
      constexpr double far = std::numeric_limits<double>::max();
      return {origin, Eigen::Vector3d::Constant(far), Eigen::Vector3d::Constant(-far), 0};
    }

    ParticleOutline outline_of(const dem::DiscreteState &state, const std::string &file, const bool reference)
    {
      std::vector<bool> bonded(state.size(), false);
      for (const auto &[a, b] : state.damage.ends)
        bonded[a] = bonded[b] = true;
      ParticleOutline outline = empty_outline(file);
      std::size_t     count   = 0;
      for (std::size_t i = 0; i < state.size(); ++i)
        if (bonded[i])
          {
            include(outline, reference ? state.reference[i] : state.position[i], state.radius[i]);
            ++count;
          }
      if (count == 0)
        throw base::InputError(file + ": no particle of this state was ever bonded; nothing to transfer.");
      outline.mean_radius /= static_cast<double>(count);
      return outline;
    }

    /** Axis at the end of "reaction_front_z"; nothing in other columns. */
    std::optional<int> axis_of(const std::string &column, const char *kind)
    {
      if (column.rfind(kind, 0) != 0 || column.size() < 2 || column[column.size() - 2] != '_')
        return {};
      const char axis = column.back();
      return axis >= 'x' && axis <= 'z' ? std::optional<int>(axis - 'x') : std::nullopt;
    }

    void refuse_other_extents(const SequentialModel &model, const SolidOutline &solid, const ParticleOutline &particles)
    {
      const bool anywhere =
        model.transfer.options.averaging.kernel == coupling::Kernel::specimen; // places do not matter
      for (int d = 0; d < model.continuum.solid.dimension; ++d)
        {
          const double mesh = solid.high[d] - solid.low[d], body = particles.high[d] - particles.low[d];
          const double tolerance = model.transfer.extents * std::max(mesh, body) + 2 * particles.mean_radius;
          const double shift =
            anywhere ? 0 :
                       std::max(std::abs(particles.low[d] - solid.low[d]), std::abs(particles.high[d] - solid.high[d]));
          if (std::abs(mesh - body) <= tolerance && shift <= tolerance)
            continue;
          throw base::InputError(fmt::format(
            "transfer: along {} {} reaches from {:.4g} to {:.4g} m and the mesh from {:.4g} to {:.4g} m: lengths "
            "and ends must agree within {:.2g} m (Transfer/Limits/Extents = {:.2g} of the length, and two "
            "particle radii). Give the mesh the extents of the particles.",
            "xyz"[d], particles.origin, particles.low[d], particles.high[d], solid.low[d], solid.high[d], tolerance,
            model.transfer.extents));
        }
    }

    /** A section given in a number is that of the specimen, or of another one: hulls of cylinders fill a half of the box, or more. */
    void refuse_specimen_area(const SequentialModel &model, const ParticleOutline &particles)
    {
      constexpr double     least = 0.5;
      const double         area  = model.particles.grips.parameters().area;
      const int            axis  = model.particles.axis;
      const Eigen::Array3d size  = particles.high - particles.low;
      const double         box   = size[(axis + 1) % 3] * size[(axis + 2) % 3];
      if (model.particles.physics.dimension == 3 && area > 0 &&
          (area < least * box || area > (1 + model.transfer.extents) * box))
        throw base::InputError(
          fmt::format("Particles/Uniaxial/Area = {:.4g}: across {} the box around the specimen has "
                      "{:.3g} m^2: expected a half of it at least, and not more.",
                      area, "xyz"[axis], box));
    }

    bool near(const double value, const double wanted, const double tolerance)
    {
      return std::abs(value - wanted) <= tolerance * std::max(std::abs(value), std::abs(wanted));
    }

    /** Unit of a column of the continuation. */
    std::string
    unit_of(const base::EntryPath &study, const char *entry, const std::string &name, const SolidOutline &solid)
    {
      std::vector<std::string> names;
      for (const auto &column : solid.columns)
        {
          if (column.name == name)
            return column.unit;
          names.push_back(column.name);
        }
      std::string all;
      for (const std::string &n : names)
        all += (all.empty() ? "" : ", ") + n;
      study.refuse(entry, "the continuation's series has no such column. " + did_you_mean(name, names) +
                            " It has: " + all + ".");
    }

    /** A displacement of a point over a length is a strain if it is that of the way from an end of the mesh to the point, or of all. */
    void
    refuse_length(const SequentialModel &model, const base::EntryPath &study, const SolidOutline &solid, const int axis)
    {
      const double        tolerance = model.transfer.extents, length = model.study.length;
      std::vector<double> lengths = {solid.high[axis] - solid.low[axis]};
      for (const auto &point : model.continuum.loads.points)
        if (model.study.horizontal == "displacement_" + column_name(point->name) + "_" + "xyz"[axis])
          {
            const double place = point->position[static_cast<std::size_t>(axis)];
            lengths.insert(lengths.end(), {place - solid.low[axis], solid.high[axis] - place});
          }
      if (std::none_of(lengths.begin(), lengths.end(), [&](const double l) { return near(length, l, tolerance); }))
        study.refuse("Length", fmt::format("the mesh is {:.4g} m long along {}: a strain is its displacement over that "
                                           "length (or over the distance of its point from an end).",
                                           lengths.front(), "xyz"[axis]));
    }

    void
    refuse_area(const SequentialModel &model, const base::EntryPath &study, const SolidOutline &solid, const int axis)
    {
      if (!near(model.study.area, solid.section(axis), model.transfer.extents))
        study.refuse("Area",
                     fmt::format("the mesh has a mean section of {:.4g} m^2 across {}: a stress is its force over "
                                 "that area.",
                                 solid.section(axis), "xyz"[axis]));
    }
  } // namespace

  double SolidOutline::mean_element_size(const int dimension) const
  {
    const double thickness = dimension == 3 ? 1 : volume / ((high[0] - low[0]) * (high[1] - low[1]));
    return std::pow(volume / thickness / static_cast<double>(elements), 1.0 / dimension);
  }

  double SolidOutline::section(const int axis) const { return volume / (high[axis] - low[axis]); }

  SolidOutline outline_of(const ContinuumModel &model)
  {
    start_mpi();
    return model.solid.dimension == 2 ? outline<2>(model) : outline<3>(model);
  }

  std::vector<ParticleOutline> outlines_of(const SequentialModel &model, const dem::Packing &packing)
  {
    std::vector<ParticleOutline> outlines;
    if (model.particles.source == ParticleEventSection::Source::file)
      {
        const bool reference = model.transfer.field.place == coupling::FieldOptions::Place::reference;
        for (const std::string &file : model.particles.files)
          outlines.push_back(outline_of(postprocess::read_discrete_state(file), file, reference));
        return outlines;
      }
    outlines.push_back(empty_outline("the specimen"));
    for (std::size_t i = 0; i < packing.size(); ++i)
      include(outlines[0], packing.centre[i], packing.radius[i]);
    outlines[0].mean_radius /= static_cast<double>(std::max<std::size_t>(packing.size(), 1));
    return outlines;
  }

  StudyUnits check_study(const SequentialModel              &model,
                         const base::EntryPath              &study,
                         const SolidOutline                 &solid,
                         const std::vector<ParticleOutline> &particles)
  {
    const SequentialModel::Study &s     = model.study;
    StudyUnits                    units = {unit_of(study, "Horizontal", s.horizontal, solid),
                                           unit_of(study, "Vertical", s.vertical, solid)};
    for (const ParticleOutline &outline : particles)
      refuse_other_extents(model, solid, outline);

    // Forces and displacements as they are need no length and no area; what is compared with stress and strain of particles does.
    const bool compared = model.particles.source == ParticleEventSection::Source::uniaxial;
    if (compared)
      refuse_specimen_area(model, particles.front());
    const auto along = axis_of(s.horizontal, "displacement_"), across = axis_of(s.vertical, "reaction_");
    for (const auto &[entry, axis] : {std::pair("Horizontal", along), std::pair("Vertical", across)})
      if (compared && axis && *axis != model.particles.axis)
        study.refuse(entry, fmt::format("the particles are strained along {} (Particles/Uniaxial/Axis).",
                                        "xyz"[model.particles.axis]));
    if (along && (compared || s.length != 1))
      refuse_length(model, study, solid, *along);
    if (across && (compared || s.area != 1))
      refuse_area(model, study, solid, *across);
    if (s.length != 1)
      units.horizontal = units.horizontal == "m" ? "-" : units.horizontal + "/m";
    if (s.area != 1)
      units.vertical = units.vertical == "N" ? "Pa" : units.vertical + "/m^2";
    return units;
  }
} // namespace apps
