#include "apps/runs/continuum/solid.h"

#include "apps/text/nearest_name.h"
#include "fem/materials/least_extent.h"
#include "fem/mesh/gmsh_file.h"
#include "fem/mesh/removal.h"
#include "fem/mesh/sides.h"

#include <deal.II/base/mpi.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace apps
{
  namespace
  {
    template <typename Id>
    std::vector<std::string> names_of(const std::map<std::string, Id> &groups)
    {
      std::vector<std::string> names;
      for (const auto &group : groups)
        names.push_back(group.first);
      return names;
    }

    std::string listed(const std::vector<std::string> &names)
    {
      std::string text;
      for (const std::string &name : names)
        text += (text.empty() ? "" : ", ") + name;
      return text.empty() ? "none" : text;
    }

    /** What a physical group of the mesh file is, if there is one of this name and another dimension; "" otherwise. */
    std::string group_of_other_dimension(const ContinuumModel &model, const std::string &name, const int wanted)
    {
      if (model.mesh.source != MeshSection::Source::file)
        return "";
      static constexpr const char *kinds[4] = {"Point", "Curve", "Surface", "Volume"};
      const fem::GmshFile          content  = fem::read_gmsh_file(model.mesh.file, model.solid.dimension);
      for (const auto &[dimension, groups] : content.groups)
        for (const auto &group : groups)
          if (group.second == name && dimension != wanted)
            return fmt::format(
              " The physical group of this name is a Physical {}, of dimension {}; a Physical {} is wanted here.",
              kinds[dimension], dimension, kinds[wanted]);
      return "";
    }

    void refuse_unknown(const std::string                  &name,
                        const std::vector<std::string>     &known,
                        const Place                        &place,
                        const std::string                  &section,
                        const std::string                  &what,
                        const std::function<std::string()> &hint)
    {
      if (std::find(known.begin(), known.end(), name) != known.end())
        return;
      const std::string nearest = did_you_mean(name, known);
      throw base::InputError(place.text() + ": " + section + "/" + name + ": the mesh has no " + what +
                             " of this name." + hint() + (nearest.empty() ? "" : " " + nearest) +
                             " It has: " + listed(known) + ".");
    }

    /** A side has two names. Loads of two sections would add up, which may be meant in one section as well, and hardly is in two. */
    void refuse_side_named_twice(const std::vector<std::unique_ptr<BoundaryCondition>> &boundaries)
    {
      for (const fem::SideName &side : fem::side_names)
        {
          const auto named = [&](const char *name) {
            return std::find_if(boundaries.begin(), boundaries.end(),
                                [name](const auto &b) { return b->name == name; });
          };
          const auto by_word = named(side.word), by_axis = named(side.by_axis);
          if (by_word != boundaries.end() && by_axis != boundaries.end())
            throw base::InputError(fmt::format("{}: Boundary conditions/{}: the same side as {}, which has a section, "
                                               "too. Put all that acts on it into one.",
                                               (*by_axis)->place.text(), side.by_axis, side.word));
        }
    }

    template <int dim>
    void refuse_names(const fem::Mesh<dim> &mesh, const ContinuumModel &model)
    {
      refuse_side_named_twice(model.loads.boundaries);
      const auto groups = names_of(mesh.materials), boundaries = names_of(mesh.boundaries);
      for (const auto &group : model.materials.groups)
        refuse_unknown(group->group, groups, group->place, "Materials", "group of elements", [&] {
          return group_of_other_dimension(model, group->group, dim) +
                 (groups.empty() ? " Give all elements a named physical group." : "");
        });
      for (const auto &boundary : model.loads.boundaries)
        refuse_unknown(boundary->name, boundaries, boundary->place, "Boundary conditions", "boundary", [&] {
          const std::string other = group_of_other_dimension(model, boundary->name, dim - 1);
          if (!other.empty() || !boundaries.empty())
            return other;
          return fmt::format(
            " Put its {} into a physical group in Gmsh, Physical {}(\"{}\"), and save the mesh with it.",
            dim == 3 ? "faces" : "edges", dim == 3 ? "Surface" : "Curve", boundary->name);
        });
      for (const std::string &name : groups)
        if (std::none_of(model.materials.groups.begin(), model.materials.groups.end(),
                         [&](const auto &group) { return group->group == name; }))
          throw base::InputError("Materials: the group \"" + name +
                                 "\" of the mesh has no law. Add subsection Materials/" + name + ".");
    }

    template <int dim>
    fem::ScalarOf<dim> scalar(const Expression &formula)
    {
      return [formula](const dealii::Point<dim> &x, const double t) {
        return formula(x[0], x[1], dim == 3 ? x[dim - 1] : 0.0, t);
      };
    }

    template <int dim>
    fem::VectorOf<dim> vector(const Expressions &formulas)
    {
      return [formulas](const dealii::Point<dim> &x, const double t) {
        dealii::Tensor<1, dim> value;
        for (unsigned int d = 0; d < dim; ++d)
          if (formulas[d].given())
            value[d] = formulas[d](x[0], x[1], dim == 3 ? x[dim - 1] : 0.0, t);
        return value;
      };
    }

    template <int dim>
    fem::Loads<dim> make_loads(const ContinuumModel &model, const TakenPlaces &taken)
    {
      fem::Loads<dim> loads;
      for (const auto &b : model.loads.boundaries)
        {
          for (unsigned int c = 0; c < dim; ++c)
            if (b->displacement[c].given())
              loads.displacements.push_back({b->name, c, scalar<dim>(b->displacement[c])});
          if (any_given(b->traction))
            loads.tractions.push_back({b->name, vector<dim>(b->traction)});
          if (b->pressure.given())
            loads.pressures.push_back({b->name, scalar<dim>(b->pressure)});
        }
      for (const auto &s : model.loads.supports)
        for (unsigned int c = 0; c < dim; ++c)
          if (s->displacement[c].given())
            loads.boxes.push_back(
              {point_of<dim>(s->from), point_of<dim>(s->is_box ? s->to : s->from), c, scalar<dim>(s->displacement[c])});
      for (const auto &f : model.loads.forces)
        {
          const dealii::Point<dim> place = point_of<dim>(f->position);
          loads.point_forces.push_back(
            {place, [place, force = vector<dim>(f->force)](const double t) { return force(place, t); }});
        }
      if (any_given(model.loads.body_force))
        loads.body_force = vector<dim>(model.loads.body_force);
      loads.body_force_is_steady = std::none_of(model.loads.body_force.begin(), model.loads.body_force.end(),
                                                [](const Expression &formula) { return formula.varies_in_time(); });
      loads.remove_rigid_motion  = model.solid.remove_rigid_motion;
      loads.may_move_freely      = !model.is_static() || taken.holds;
      return loads;
    }

    /** Elements of one group whose softening goes by the size of the mesh, and how many are too wide for it in every direction. */
    struct WideElements
    {
      double limit = 0, least = std::numeric_limits<double>::infinity(); ///< width [m]: that can break, that there is
      std::size_t wide = 0, all = 0;
    };

    template <int dim>
    WideElements wide_elements(const fem::Solid<dim> &solid, const MaterialOfGroup &group)
    {
      WideElements found;
      found.limit            = group.chosen().constants->largest_element_size();
      const auto *const mine = &solid.material(solid.mesh().materials.at(group.group));
      for (const auto &element : solid.element_points())
        if (element.material == mine)
          {
            double width = std::numeric_limits<double>::infinity();
            for (int d = 0; d < dim; ++d)
              width = std::min(width, element.extent.along(Eigen::Vector3d::Unit(d)));
            if (!(width < found.limit))
              width = fem::least_extent(element.extent);
            found.wide += width < found.limit ? 0 : 1;
            found.least = std::min(found.least, width);
            ++found.all;
          }
      found.least = dealii::Utilities::MPI::min(found.least, solid.communicator());
      found.wide  = dealii::Utilities::MPI::sum(found.wide, solid.communicator());
      found.all   = dealii::Utilities::MPI::sum(found.all, solid.communicator());
      return found;
    }

    bool takes_its_size_from_the_mesh(const MaterialOfGroup &group)
    {
      return std::isfinite(group.chosen().constants->largest_element_size());
    }

    /** Before anything is computed: no element of a group could crack without being refused then. */
    template <int dim>
    void refuse_wide_elements(const fem::Solid<dim> &solid, const ContinuumModel &model)
    {
      for (const auto &group : model.materials.groups)
        if (takes_its_size_from_the_mesh(*group))
          if (const WideElements found = wide_elements(solid, *group); found.all > 0 && found.wide == found.all)
            group->require_element_size(found.least); // says by how much
    }
  } // namespace

  template <int dim>
  std::vector<std::string> coarse_elements(const fem::Solid<dim> &solid, const ContinuumModel &model)
  {
    std::vector<std::string> warnings;
    for (const auto &group : model.materials.groups)
      if (takes_its_size_from_the_mesh(*group))
        if (const WideElements found = wide_elements(solid, *group); found.wide > 0)
          warnings.push_back(
            fmt::format("{} of {} elements of \"{}\" are wider than E w_f / f_t = {:.4g} m: where one of "
                        "them cracks the run ends",
                        found.wide, found.all, group->group, found.limit));
    return warnings;
  }

  template <int dim>
  std::unique_ptr<fem::Solid<dim>> make_solid(const ContinuumModel &model, const TakenPlaces &taken)
  {
    fem::SolidOptions options;
    options.degree             = static_cast<unsigned int>(model.solid.degree);
    options.plane              = model.solid.plane_stress && dim == 2 ? fem::Plane::stress : fem::Plane::strain;
    options.thickness          = dim == 2 ? model.solid.thickness : 1.0;
    options.large_displacement = model.solid.large_displacement;
    options.mean_dilatation    = model.solid.mean_dilatation;
    options.share              = taken.share;
    fem::Mesh<dim> mesh        = make_mesh<dim>(model.mesh, model.ranks_of_mesh());
    if (taken.whole)
      mesh = fem::without_elements<dim>(mesh, [&](const dealii::Point<dim> &place) {
        return taken.whole({place[0], place[1], dim == 3 ? place[dim - 1] : 0.0});
      });
    refuse_names(mesh, model);
    auto solid = std::make_unique<fem::Solid<dim>>(std::move(mesh), options);
    for (const auto &group : model.materials.groups)
      solid->assign(group->group, group->make_points(options.plane));
    solid->set_loads(make_loads<dim>(model, taken));
    refuse_wide_elements(*solid, model);
    return solid;
  }

  template std::unique_ptr<fem::Solid<2>> make_solid(const ContinuumModel &, const TakenPlaces &);
  template std::unique_ptr<fem::Solid<3>> make_solid(const ContinuumModel &, const TakenPlaces &);
  template std::vector<std::string>       coarse_elements(const fem::Solid<2> &, const ContinuumModel &);
  template std::vector<std::string>       coarse_elements(const fem::Solid<3> &, const ContinuumModel &);
} // namespace apps
