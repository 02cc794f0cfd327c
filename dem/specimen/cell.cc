#include "base/errors.h"
#include "dem/measures/link_measures.h"
#include "dem/model/strain_operator.h"
#include "dem/specimen/core.h"
#include "dem/specimen/specimen.h"

#include <Eigen/LU>

namespace dem
{
  namespace
  {
    void require_cell(const Particles &particles, const char *what)
    {
      if (!particles.cell.repeats())
        throw base::InputError(std::string(what) +
                               ": the specimen has no periodic cell. Make it with Periodic = true.");
    }

    /** Sum of H^T C H over the links [N m]. */
    base::Matrix6 stiffness_moment(const Particles &particles, const LinkSet &links, const LinkLaw &law)
    {
      LinkReader    reader(particles, links, law);
      base::Matrix6 sum = base::Matrix6::Zero();
      for (std::size_t l = 0; l < links.count; ++l)
        {
          if (!links.is_alive(l))
            continue;
          reader.read(l);
          const LinkView       &view      = reader.view();
          const LinkStiffnesses moduli    = reader.damaged_stiffness();
          const auto            along     = view.direction * view.direction.transpose();
          const double          per_slip  = links.area[l] / links.reference_length[l];
          const auto            operation = strain_operator(view.length * view.direction);
          const Eigen::Matrix3d stiffness =
            per_slip * (moduli.normal * along + moduli.shear * (Eigen::Matrix3d::Identity() - along));
          sum += operation.transpose() * stiffness * operation;
        }
      return sum;
    }

    double sum_of_forces(SpecimenCore &core, const LinkSet &links)
    {
      double sum = 0;
      core.walk(links, &sum, 1, [&](const LinkRange &lines) {
        each_living(links, lines,
                    [&](const std::size_t l) { sum += Eigen::Vector3d(&links.force[record_size * l]).norm(); });
      });
      return sum;
    }
  } // namespace

  void Specimen::set_velocity_gradient(const Eigen::Matrix3d &gradient)
  {
    require_cell(self->particles, "velocity gradient");
    self->particles.cell.set_gradient(gradient);
  }

  CellState ObservedSpecimen::cell() const
  {
    require_cell(self->particles, "cell");
    const Cell           &cell = self->particles.cell;
    const Eigen::Matrix3d back = Eigen::Matrix3d::Identity() - cell.last_increment();
    CellState             state;
    state.base                  = cell.base();
    state.deformation           = cell.deformation();
    state.deformation_at_forces = back * cell.deformation();
    state.volume                = back.determinant() * cell.volume();
    state.stress                = self->stress_moment / state.volume;
    return state;
  }

  base::Matrix6 ObservedSpecimen::affine_stiffness() const
  {
    self->gather();
    require_cell(self->particles, "affine stiffness");
    return (stiffness_moment(self->particles, self->bonds, *self->bond_law) +
            stiffness_moment(self->particles, self->contacts, *self->contact_law)) /
           self->particles.cell.volume();
  }

  double ObservedSpecimen::force_ratio() const
  {
    self->gather();
    const Particles &p    = self->particles;
    double           left = 0, all = 0;
    const auto       free = [&](const std::size_t i) {
      const Eigen::Vector3d mobile(&p.inverse_mass[record_size * i]);
      return Eigen::Vector3d((mobile.array() > 0).cast<double>());
    };
    for (std::size_t i = 0; i < p.count; ++i)
      {
        left += Eigen::Vector3d(&p.force[record_size * i]).cwiseProduct(free(i)).norm();
        if (free(i).any())
          all += p.mass[i] * self->parameters.gravity.norm();
      }
    for (const LinkSet *links : {&self->bonds, &self->contacts})
      for (std::size_t l = 0; l < links->count; ++l)
        if (links->is_alive(l))
          {
            const double size = Eigen::Vector3d(&links->force[record_size * l]).norm();
            for (const std::int32_t i : {links->first[l], links->second[l]})
              if (free(static_cast<std::size_t>(i)).any())
                all += size;
          }
    self->surfaces.each_push(
      [&](std::int32_t, const std::int32_t particle, const Eigen::Vector3d &force, const Eigen::Vector3d &) {
        if (free(static_cast<std::size_t>(particle)).any())
          all += force.norm();
      });
    return all > 0 ? left / all : 1.0;
  }

  double ObservedSpecimen::unbalanced_ratio() const
  {
    const Particles &p            = self->particles;
    double           sums[2]      = {0, 0};
    double          &on_particles = sums[0], &moving = sums[1];
    self->walk_particles(sums, 2, [&](const std::size_t first, const std::size_t last) {
      for (std::size_t i = first; i < last; ++i)
        {
          const Eigen::Vector3d force(&p.force[record_size * i]), mobile(&p.inverse_mass[record_size * i]);
          if ((mobile.array() > 0).any())
            {
              on_particles += (mobile.array() > 0).select(force.array(), 0.0).matrix().norm();
              ++moving;
            }
        }
    });
    double of_links = sum_of_forces(*self, self->bonds) + sum_of_forces(*self, self->contacts);
    self->gather_wall_contacts();
    const std::size_t links = self->bonds.alive + self->touching_contacts() + self->surfaces.count();
    for (const SurfaceContact &contact : self->surfaces.list())
      of_links += contact.force.norm();
    if (moving == 0 || on_particles == 0)
      return 0.0;
    return on_particles / moving / (of_links / static_cast<double>(links));
  }
} // namespace dem
