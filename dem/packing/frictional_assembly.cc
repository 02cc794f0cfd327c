#include "dem/packing/frictional_assembly.h"

#include "dem/laws/linear_contact.h"

#include <algorithm>
#include <cmath>

namespace dem
{
  namespace
  {
    /** Part of the stable step that a step may be. */
    constexpr double step_factor = 0.95;

    SpecimenParameters specimen_parameters(const FrictionalAssemblyParameters &p)
    {
      SpecimenParameters s;
      s.physics.damage    = false;
      s.physics.periodic  = true;
      s.density           = 3.0 / (4.0 * M_PI); // mass 1
      s.interaction_ratio = 1;
      s.step_factor       = step_factor;
      s.damping           = p.damping;
      return s;
    }

    LinearContactParameters contacts(const FrictionalAssemblyParameters &p)
    {
      LinearContactParameters linear;
      linear.effective_modulus    = 2.0 / M_PI; // k_n = pi r^2 E* / (2 r) = 1
      linear.stiffness_ratio      = 1.0 / std::max(p.shear_ratio, 1e-12);
      linear.friction_coefficient = p.friction;
      return linear;
    }

    double pressure_of(const Specimen &specimen) { return -specimen.cell().stress.trace() / 3; }
  } // namespace

  FrictionalAssembly::FrictionalAssembly(const Packing &start, const FrictionalAssemblyParameters &p)
    : specimen(start, specimen_parameters(p), contacts(p))
    , spheres(start.size())
  {
    specimen.set_time_step(std::min(p.time_step, specimen.longest_step()));
  }

  void
  FrictionalAssembly::set_motion(const std::size_t sphere, const Eigen::Vector3d &velocity, const Eigen::Vector3d &spin)
  {
    specimen.set_velocity(sphere, velocity, spin);
  }

  Eigen::Vector3d FrictionalAssembly::spin(const std::size_t sphere) const { return specimen.particle(sphere).spin; }

  void FrictionalAssembly::advance(const std::int64_t steps, const std::function<double(double)> &strain)
  {
    const auto grow = [&] {
      specimen.set_velocity_gradient(strain(pressure_of(specimen)) / specimen.time_step() *
                                     Eigen::Matrix3d::Identity());
      return true;
    };
    grow();
    specimen.advance(steps, grow);
  }

  Eigen::Vector3d FrictionalAssembly::edges() const
  {
    const CellState cell = specimen.cell();
    return cell.base.diagonal().cwiseProduct(
      cell.deformation_at_forces.diagonal().cwiseQuotient(cell.deformation.diagonal()));
  }

  AssemblyMeasures FrictionalAssembly::measures() const
  {
    return {pressure_of(specimen), specimen.unbalanced_ratio(), static_cast<std::int64_t>(specimen.counts().contacts)};
  }

  double FrictionalAssembly::mean_overlap() const
  {
    const LinkOutput contacts = specimen.links();
    double           sum      = 0;
    for (const double strain : contacts.normal_strain)
      sum -= 2 * strain; // of the sum of two radii
    return contacts.normal_strain.empty() ? 0.0 : sum / static_cast<double>(contacts.normal_strain.size());
  }

  std::vector<Eigen::Vector3d> FrictionalAssembly::centres() const
  {
    const Eigen::Vector3d        cell = edges();
    std::vector<Eigen::Vector3d> result(spheres);
    for (std::size_t i = 0; i < spheres; ++i)
      {
        const ParticleState   sphere = specimen.particle(i);
        const Eigen::Vector3d x      = sphere.position - sphere.moved;
        for (int d = 0; d < 3; ++d)
          result[i][d] = x[d] - cell[d] * std::floor(x[d] / cell[d]);
      }
    return result;
  }
} // namespace dem
