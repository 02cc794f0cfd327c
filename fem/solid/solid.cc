#include "fem/solid/solid.h"

#include "base/errors.h"
#include "base/number_text.h"
#include "fem/solid/block_builder.h"
#include "fem/solid/element_sweep.h"
#include "fem/solid/nonlocal_coupling.h"

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/mapping_fe.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/lac/trilinos_sparsity_pattern.h>

namespace fem
{
  using namespace dealii;

  template <int dim>
  Solid<dim>::Solid(Mesh<dim> mesh, const SolidOptions &options)
    : grid(std::move(mesh))
    , settings(options)
    , dof_handler(*grid.triangulation)
  {
    if (options.degree < 1 || options.degree > 2)
      throw base::InputError("Degree = " + std::to_string(options.degree) + ": must be 1 or 2.");
    if (dim == 2 && !(options.thickness > 0))
      throw base::InputError("Thickness = " + base::number_text(options.thickness) + " m: must be positive.");
    if (options.large_displacement && options.mean_dilatation)
      throw base::InputError("Mean dilatation: is a small-strain form. Switch it off with large displacements.");
    if (dim == 2 && options.plane == Plane::stress && options.mean_dilatation)
      throw base::InputError("Mean dilatation: plane stress does not lock. Switch it off.");

    const unsigned int k = options.degree;
    if (grid.family == ElementFamily::hypercube)
      {
        element     = std::make_unique<FESystem<dim>>(FE_Q<dim>(k), dim);
        geometry    = std::make_unique<MappingQ<dim>>(1);
        points      = QGauss<dim>(k + 1);
        load_points = QGauss<dim>(k + 2);
        face_points = QGauss<dim - 1>(k + 2);
      }
    else
      {
        element     = std::make_unique<FESystem<dim>>(FE_SimplexP<dim>(k), dim);
        geometry    = std::make_unique<MappingFE<dim>>(FE_SimplexP<dim>(1));
        points      = QGaussSimplex<dim>(k);
        load_points = QGaussSimplex<dim>(k + 2);
        face_points = QGaussSimplex<dim - 1>(k + 2);
      }
    dof_handler.distribute_dofs(*element);
    owned = dof_handler.locally_owned_dofs();
    DoFTools::extract_locally_relevant_dofs(dof_handler, relevant);
    supports.reinit(relevant);
    supports.close();
    layout = std::make_shared<const Utilities::MPI::Partitioner>(owned, relevant, communicator());
  }

  template <int dim>
  Solid<dim>::~Solid() = default;

  template <int dim>
  void Solid<dim>::assign(const std::string &material_name, std::unique_ptr<MaterialPoints> law)
  {
    if (grid.materials.find(material_name) == grid.materials.end())
      {
        std::string known;
        for (const auto &entry : grid.materials)
          known += (known.empty() ? "" : ", ") + entry.first;
        throw base::InputError("material = " + material_name + ": the mesh has no such group. It has: " + known + ".");
      }
    if (settings.large_displacement && !law->takes_large_strains())
      throw base::InputError(std::string(law->material_name()) +
                             ": is a small-strain law. Large displacements need an elastic material.");
    materials[material_name] = std::move(law);
  }

  template <int dim>
  void Solid<dim>::allocate_points()
  {
    std::map<MaterialPoints *, std::size_t> count;
    bool                                    history = false;
    material_of.clear();
    element_blocks.clear();
    for (const auto &entry : grid.materials)
      {
        const auto law = materials.find(entry.first);
        if (law == materials.end())
          throw base::InputError("material = " + entry.first +
                                 ": this group of the mesh has no material law. Give it one.");
        material_of[entry.second] = law->second.get();
        history                   = history || !law->second->linear();
      }
    elements.clear();
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          ElementPoints e;
          e.material = material_of.at(cell->material_id());
          e.first    = count[e.material];
          count[e.material] += points.size();
          if (history)
            {
              e.extent.n_vertices = cell->n_vertices();
              for (unsigned int v = 0; v < cell->n_vertices(); ++v)
                for (unsigned int d = 0; d < dim; ++d)
                  e.extent.vertices[v][d] = cell->vertex(v)[d];
              e.extent.mean_size = std::pow(cell->measure(), 1.0 / dim);
            }
          elements.push_back(e);
        }
    for (auto &law : materials)
      law.second->allocate(count[law.second.get()]);
    place_gathered_points();
    if (NonlocalCoupling<dim>::wanted(*this))
      {
        if (settings.share)
          throw base::InputError("a material averaged over a length cannot share its place with particles.");
        nonlocal = std::make_unique<NonlocalCoupling<dim>>(*this);
      }
  }

  template <int dim>
  void Solid<dim>::set_loads(const Loads<dim> &given)
  {
    loads = given;
    allocate_points();
    place_supports();
    place_forces();
  }

  template <int dim>
  Vector Solid<dim>::make_vector() const
  {
    Vector v;
    v.reinit(layout);
    return v;
  }

  template <int dim>
  void Solid<dim>::make_matrix(Matrix &matrix) const
  {
    TrilinosWrappers::SparsityPattern pattern(owned, owned, relevant, communicator());
    DoFTools::make_sparsity_pattern(dof_handler, pattern, supports, false,
                                    Utilities::MPI::this_mpi_process(communicator()));
    if (nonlocal)
      nonlocal->add_to(pattern);
    pattern.compress();
    matrix.reinit(pattern);
  }

  namespace
  {
    /// action(vector or matrix) on everything that a sweep gives.
    template <typename Action>
    void each_of(const Sweep &wanted, const Action &action)
    {
      if (wanted.internal_force)
        action(*wanted.internal_force);
      if (wanted.tangent)
        action(*wanted.tangent);
      for (const auto &product : wanted.products)
        action(*product.second);
    }
  } // namespace

  template <int dim>
  void Solid<dim>::sweep(const Vector &displacement, const Sweep &wanted)
  {
    const bool stiffness = wanted.tangent || !wanted.products.empty();
    each_of(wanted, [](auto &sum) { sum = 0; });
    if (nonlocal)
      nonlocal->flow(displacement, stiffness);
    gather(displacement, stiffness);

    // A failure is reported once all ranks know of it: the others wait for this one in what follows.
    ElementSweep<dim> at_hand(*this);
    std::string       failure;
    std::size_t       next = 0;
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned() && failure.empty())
        try
          {
            at_hand.reinit(cell, displacement);
            at_hand.integrate(elements[next++], stiffness);
            at_hand.add_to(wanted);
          }
        catch (const MaterialFailure &problem)
          {
            failure = problem.what();
          }
    if (Utilities::MPI::max(failure.empty() ? 0 : 1, communicator()) == 1)
      throw MaterialFailure(failure.empty() ? "a point on another rank found no stress." : failure);
    if (nonlocal && stiffness)
      nonlocal->add_tangent(displacement, wanted);
    each_of(wanted, [](auto &sum) { sum.compress(VectorOperation::add); });
  }

  template <int dim>
  bool Solid<dim>::has_blocks() const
  {
    return linear() && !settings.mean_dilatation;
  }

  template <int dim>
  const std::vector<ElementBlocks> &Solid<dim>::blocks() const
  {
    if (!element_blocks.empty() || !has_blocks())
      return element_blocks;
    BlockBuilder<dim, double>            builder(*this);
    std::vector<types::global_dof_index> indices(element->n_dofs_per_cell());
    std::vector<unsigned int>            positions(indices.size());
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          cell->get_dof_indices(indices);
          for (unsigned int i = 0; i < indices.size(); ++i)
            positions[i] = layout->global_to_local(indices[i]);
          builder.add(cell, positions, material(cell->material_id()));
        }
    element_blocks = builder.take();
    return element_blocks;
  }

  template <int dim>
  void Solid<dim>::internal_force(const Vector &displacement, Vector &force)
  {
    if (has_blocks())
      {
        force = 0;
        for (const ElementBlocks &e : blocks())
          add_internal_force(e, displacement.begin(), force.begin());
        force.compress(VectorOperation::add);
        if (std::isfinite(force.l2_norm()))
          return;
      } // not a number: the sweep finds the element
    Sweep wanted;
    wanted.internal_force = &force;
    sweep(displacement, wanted);
  }

  template <int dim>
  void Solid<dim>::visit_points(const Vector &displacement, const std::function<void(const PointView<dim> &)> &visit)
  {
    ElementSweep<dim> at_hand(*this, update_quadrature_points);
    const double      thickness = dim == 2 ? settings.thickness : 1.0;
    std::size_t       next      = 0;
    PointAnswer       answer;
    if (nonlocal)
      nonlocal->flow(displacement, false);
    gather(displacement, false);
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const ElementPoints &e = elements[next++];
          at_hand.reinit(cell, displacement);
          for (unsigned int q = 0; q < points.size(); ++q)
            {
              const base::Voigt strain = at_hand.strain(q);
              e.material->evaluate(e.first + q, strain, e.extent, false, answer);
              const Point<dim> &place  = at_hand.at_points().quadrature_point(q);
              const double      volume = at_hand.at_points().JxW(q) * thickness * share_at(settings, place);
              visit({cell, place, volume, strain, answer.stress, e.material, e.first + q});
            }
        }
  }

  template <int dim>
  void Solid<dim>::begin_step()
  {
    for (auto &law : materials)
      law.second->begin_step();
  }

  template <int dim>
  Dissipation Solid<dim>::dissipated() const
  {
    Dissipation sum;
    if (linear())
      return sum;
    FEValues<dim> values(*geometry, *element, points, update_quadrature_points | update_JxW_values);
    const double  thickness = dim == 2 ? settings.thickness : 1.0;
    std::size_t   next      = 0;
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const ElementPoints &e       = elements[next++];
          bool                 reached = false; // most elements dissipate nothing
          for (unsigned int q = 0; q < points.size(); ++q)
            {
              const Dissipation d = e.material->dissipated(e.first + q, e.extent);
              if (d.plasticity == 0 && d.damage == 0)
                continue;
              if (!reached)
                values.reinit(cell);
              reached = true;
              sum.add(d, thickness * values.JxW(q) * share_at(settings, values.quadrature_point(q)));
            }
        }
    sum.plasticity = Utilities::MPI::sum(sum.plasticity, communicator());
    sum.damage     = Utilities::MPI::sum(sum.damage, communicator());
    return sum;
  }

  template <int dim>
  void Solid<dim>::commit()
  {
    for (auto &law : materials)
      law.second->commit();
  }

  template <int dim>
  bool Solid<dim>::linear() const
  {
    bool all = !settings.large_displacement;
    for (const auto &law : materials)
      all = all && law.second->linear();
    return all;
  }

  template class Solid<2>;
  template class Solid<3>;
}
