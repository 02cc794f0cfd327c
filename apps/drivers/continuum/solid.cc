#include "apps/drivers/continuum/solid.h"

#include "apps/scene/nearest_name.h"

#include <algorithm>

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

    void refuse_unknown(const std::string              &name,
                        const std::vector<std::string> &known,
                        const Place                    &place,
                        const std::string              &section,
                        const std::string              &what)
    {
      if (std::find(known.begin(), known.end(), name) == known.end())
        throw dem::InputError(place.text() + ": " + section + "/" + name + ": the mesh has no " + what +
                              " of this name. " + did_you_mean(name, known) + " It has: " + listed(known) + ".");
    }

    template <int dim>
    void refuse_names(const fem::Mesh<dim> &mesh, const ContinuumModel &model)
    {
      const auto groups = names_of(mesh.materials), boundaries = names_of(mesh.boundaries);
      for (const auto &group : model.materials.groups)
        refuse_unknown(group->group, groups, group->place, "Materials", "group of elements");
      for (const auto &boundary : model.loads.boundaries)
        refuse_unknown(boundary->name, boundaries, boundary->place, "Boundary conditions", "boundary");
      for (const std::string &name : groups)
        if (std::none_of(model.materials.groups.begin(), model.materials.groups.end(),
                         [&](const auto &group) { return group->group == name; }))
          throw dem::InputError("Materials: the group \"" + name +
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
    fem::Loads<dim> make_loads(const ContinuumModel &model)
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
      loads.may_move_freely      = !model.is_static();
      return loads;
    }
  } // namespace

  template <int dim>
  std::unique_ptr<fem::Solid<dim>> make_solid(const ContinuumModel &model)
  {
    fem::SolidOptions options;
    options.degree             = static_cast<unsigned int>(model.solid.degree);
    options.plane              = model.solid.plane_stress && dim == 2 ? fem::Plane::stress : fem::Plane::strain;
    options.thickness          = dim == 2 ? model.solid.thickness : 1.0;
    options.large_displacement = model.solid.large_displacement;
    options.mean_dilatation    = model.solid.mean_dilatation;
    try
      {
        fem::Mesh<dim> mesh = make_mesh<dim>(model.mesh);
        refuse_names(mesh, model);
        auto solid = std::make_unique<fem::Solid<dim>>(std::move(mesh), options);
        for (const auto &group : model.materials.groups)
          solid->assign(group->group, group->make_points(options.plane));
        solid->set_loads(make_loads<dim>(model));
        return solid;
      }
    catch (const std::invalid_argument &refusal)
      {
        throw dem::InputError(refusal.what());
      }
  }

  template std::unique_ptr<fem::Solid<2>> make_solid(const ContinuumModel &);
  template std::unique_ptr<fem::Solid<3>> make_solid(const ContinuumModel &);
} // namespace apps
