#pragma once

#include "coupling/concurrent/concurrent_motion.h"
#include "fem/materials/isotropic_elastic.h"
#include "fem/mesh/mesh.h"
#include "tests/dem/clusters.h"
#include "tests/fem/solid_fixture.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <deal.II/base/mpi.h>

#include <cmath>
#include <functional>
#include <memory>

/** Deformable bodies of one mesh that touch each other. */
namespace contact_fixture
{
  using Eigen::Vector3d;

  /** A box of a mesh of several. */
  template <int dim>
  struct Part
  {
    dealii::Point<dim>        from, to;
    std::vector<unsigned int> elements;
    double                    turned = 0; ///< about z [rad]
  };

  template <int dim>
  inline fem::Mesh<dim> parts(const std::vector<Part<dim>> &all, const fem::ElementFamily family)
  {
    return fem::make_mesh<dim>(
      [&all](dealii::Triangulation<dim> &mesh) {
        std::vector<dealii::Point<dim>>    points;
        std::vector<dealii::CellData<dim>> cells;
        for (std::size_t p = 0; p < all.size(); ++p)
          {
            dealii::Triangulation<dim> part;
            dealii::GridGenerator::subdivided_hyper_rectangle(part, all[p].elements, all[p].from, all[p].to);
            const double c = std::cos(all[p].turned), s = std::sin(all[p].turned);
            const auto   first = static_cast<unsigned int>(points.size());
            for (dealii::Point<dim> x : part.get_vertices())
              {
                const double along = x[0], across = x[1];
                x[0] = c * along - s * across;
                x[1] = s * along + c * across;
                points.push_back(x);
              }
            for (const auto &cell : part.active_cell_iterators())
              {
                dealii::CellData<dim> data;
                data.material_id = static_cast<dealii::types::material_id>(p);
                for (const unsigned int v : cell->vertex_indices())
                  data.vertices[v] = first + cell->vertex_index(v);
                cells.push_back(data);
              }
          }
        mesh.create_triangulation(points, cells, dealii::SubCellData());
      },
      family, MPI_COMM_SELF, fem::Bodies::several);
  }

  /** A particle far away from everything: the motion has two sides. */
  inline dem::Specimen bystander()
  {
    dem::Packing packing;
    packing.centre = {{1e3, 1e3, 0}};
    packing.radius = {1};
    auto p         = cluster::bonded(1.0);
    p.density      = 1000;
    dem::LinearContactParameters law;
    law.effective_modulus = 1e6;
    return dem::Specimen(packing, p, law);
  }

  template <int dim>
  struct Bodies
  {
    using Velocity = std::function<dealii::Tensor<1, dim>(const dealii::Point<dim> &)>;

    Bodies(fem::Mesh<dim>                                 mesh,
           const Velocity                                &velocity,
           const coupling::bodies::BodyContactParameters &contact,
           const double                                   young   = 1e7,
           const double                                   safety  = 0.5,
           const std::array<double, 3>                   &gravity = {0, 0, 0},
           const bool                                     held    = false,
           const std::vector<std::string>                &rigid   = {})
      : solid(std::move(mesh), options())
      , specimen(bystander())
    {
      const auto           names = solid.mesh().materials;
      fem::ExplicitOptions explicitly;
      for (const auto &entry : names)
        {
          solid.assign(entry.first, fem::make_points(elastic(young, 0.2), fem::Plane::strain));
          explicitly.density[entry.first] = 2000;
        }
      explicitly.safety  = safety;
      explicitly.gravity = gravity;
      fem::Loads<dim> loads;
      loads.may_move_freely = true;
      if (held)
        for (unsigned int c = 0; c < dim; ++c)
          loads.boxes.push_back(
            {underside(-1e3), underside(1e3), c, [](const dealii::Point<dim> &, double) { return 0.0; }});
      solid.set_loads(loads);
      motion = std::make_unique<fem::ExplicitSolver<dim>>(solid, explicitly);
      motion->set_velocity([velocity](const dealii::Point<dim> &x, double) { return velocity(x); });
      participant = std::make_unique<coupling::SolidParticipant<dim>>(solid, *motion);
      for (const auto &cell : solid.dofs().active_cell_iterators())
        for (const unsigned int v : cell->vertex_indices())
          body_of[cell->vertex_dof_index(v, 0)] = cell->material_id();
      both = std::make_unique<coupling::ConcurrentMotion<dim>>(specimen, solid, *motion, *participant,
                                                               std::function<void()>(), rigid);
      both->contacts().add({"contact", {}, contact});
    }
    /** Corners of a box around all that lies half a metre under the origin. */
    static dealii::Point<dim> underside(const double out)
    {
      dealii::Point<dim> corner;
      for (int d = 0; d < dim; ++d)
        corner[d] = d == 2 ? -0.5 + 1e-9 * out : out;
      return corner;
    }
    static fem::SolidOptions options()
    {
      fem::SolidOptions o;
      o.large_displacement = true;
      return o;
    }
    const coupling::ContactCoupling<dim> &contact() const { return *both->contacts().all().front(); }
    /** Mean of a body's nodes, by its number. */
    Vector3d velocity_of(const std::size_t body) const
    {
      Vector3d sum  = Vector3d::Zero();
      double   mass = 0;
      for (std::size_t i = 0; i < participant->carriers(); ++i)
        if (body_of.at(participant->displacements(i)[0]) == body)
          {
            sum += participant->mass(i) * participant->velocity(i);
            mass += participant->mass(i);
          }
      return sum / mass;
    }
    double energy() const
    {
      const auto  e = motion->energy();
      const auto &c = contact().balance().energy;
      return e.kinetic + e.internal + c.normal + c.shear + c.dissipated;
    }

    fem::Solid<dim>                                        solid;
    dem::Specimen                                          specimen;
    std::unique_ptr<fem::ExplicitSolver<dim>>              motion;
    std::unique_ptr<coupling::SolidParticipant<dim>>       participant;
    std::unique_ptr<coupling::ConcurrentMotion<dim>>       both;
    std::map<dealii::types::global_dof_index, std::size_t> body_of; ///< by the first displacement of a node
  };

  inline coupling::bodies::BodyContactParameters contact(const coupling::bodies::BodyContactForm form,
                                                         const double                            friction)
  {
    coupling::bodies::BodyContactParameters law;
    law.form                 = form;
    law.stiffness            = 4e8;
    law.friction_coefficient = friction;
    return law;
  }

  /** A small cube that hits a corner of a larger one askew. */
  inline std::vector<Part<3>> cubes()
  {
    return {{{0, 0, 0}, {1, 1, 1}, {3, 3, 3}, 0}, {{1.25, 0.0, 0.55}, {1.85, 0.6, 1.15}, {2, 2, 2}, 0.2}};
  }
} // namespace contact_fixture
