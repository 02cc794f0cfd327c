// Four runs whose bits are committed: the same on every processor, for vectors of 64, 32 and 16 bytes (BRECCIA_VECTOR), for GCC and
// Clang, and for any number of threads. A change of the order of operations changes them; then CHANGELOG says so.
#include "clusters.h"
#include "dem/core/kernel_vectors.h"
#include "dem/facets/shapes.h"
#include "dem/facets/surface.h"
#include "dem/laws/flat_joint.h"
#include "dem/laws/linear_contact.h"
#include "dem/laws/parallel_bond.h"
#include "dem/packing/compaction.h"
#include "dem/packing/lattice.h"
#include "dem/specimen/specimen.h"
#include "falling_grains.h"

#include <catch2/catch.hpp>

#include <omp.h>

#include <cstdint>
#include <cstring>
#include <vector>

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace
{
  /** FNV-1a over the bits of numbers (Fowler, Noll, Vo, 1991). */
  class Fingerprint
  {
  public:
    void add(const double number)
    {
      std::uint64_t bits;
      std::memcpy(&bits, &number, sizeof(bits));
      for (int byte = 0; byte < 8; ++byte)
        hash = (hash ^ (bits >> 8 * byte & 0xff)) * 0x100000001b3;
    }
    void add(const Vector3d &v)
    {
      for (int c = 0; c < 3; ++c)
        add(v[c]);
    }
    void add(const std::vector<double> &all)
    {
      for (const double number : all)
        add(number);
    }
    void add(const std::vector<Vector3d> &all)
    {
      for (const Vector3d &v : all)
        add(v);
    }
    std::uint64_t value() const { return hash; }

  private:
    std::uint64_t hash = 0xcbf29ce484222325;
  };

  /** Where particles are and how they move, what links carry and remember, and the energy account. */
  std::uint64_t fingerprint_of(const dem::Specimen &specimen)
  {
    Fingerprint               print;
    const dem::ParticleOutput particles = specimen.particles();
    print.add(particles.position);
    print.add(particles.velocity);
    print.add(particles.angular_velocity);
    const dem::LinkOutput links = specimen.links();
    print.add(links.normal_force);
    print.add(links.shear_force);
    for (const std::vector<double> &column : links.history)
      print.add(column);
    specimen.energy().each([&](const char *, const double part) { print.add(part); });
    return print.value();
  }

  /** A packing is made, its links soften and slide while the cell is pulled and sheared, and broken ends touch again. */
  dem::Specimen concrete_in_cell()
  {
    dem::CompactionParameters loose;
    loose.radius                       = 1e-3;
    loose.count                        = 200;
    dem::SpecimenParameters parameters = cluster::bonded(1.5);
    parameters.physics.periodic        = true;
    dem::Specimen specimen(dem::compact(loose).packing, parameters, cluster::concrete());
    Matrix3d      gradient = Matrix3d::Zero();
    gradient(0, 0)         = 20;
    gradient(0, 1)         = 15;
    specimen.set_velocity_gradient(gradient);
    specimen.advance(400);
    specimen.set_velocity_gradient(-gradient);
    specimen.advance(400);
    return specimen;
  }

  /** Spheres of two sizes in a spinning, bending, breaking cluster. */
  dem::Specimen cemented_cluster()
  {
    dem::ParallelBondParameters cement;
    cement.effective_modulus           = 25e9;
    cement.stiffness_ratio             = 2.5;
    cement.friction_coefficient        = 0.8;
    cement.tensile_strength            = 20e6;
    cement.cohesion                    = 30e6;
    cement.friction_angle              = 30;
    dem::SpecimenParameters parameters = cluster::bonded(1.05);
    parameters.damping                 = 0.1;
    const dem::Packing packing         = cluster::random_cluster(7, 300, 0.7e-3, 1e-3);
    dem::Specimen      specimen(packing, parameters, cement);
    for (std::size_t i = 0; i < packing.size(); ++i)
      specimen.set_velocity(i, 40 * packing.centre[i].cross(Vector3d(5, -2, 9)), Vector3d(100, 0, -300));
    specimen.advance(600);
    return specimen;
  }

  /** Discs with joints of three elements, some of them slit from the start, sheared while they are pressed together. */
  dem::Specimen jointed_discs()
  {
    dem::FlatJointParameters joints;
    joints.effective_modulus           = 10e9;
    joints.stiffness_ratio             = 1.5;
    joints.friction_coefficient        = 0.5;
    joints.tensile_strength            = 5e6;
    joints.cohesion                    = 10e6;
    joints.elements                    = 3;
    joints.slit_fraction               = 0.2;
    dem::SpecimenParameters parameters = cluster::next_neighbours();
    parameters.physics.dimension       = 2;
    parameters.thickness               = 1e-3;
    dem::Packing packing               = dem::make_lattice(dem::Lattice::hexagonal, 1e-3, {12, 6, 1});
    packing.periodic_cell.reset();
    dem::Specimen specimen(packing, parameters, joints);
    for (std::size_t i = 0; i < packing.size(); ++i)
      {
        const Vector3d &x = packing.centre[i];
        specimen.set_velocity(i, 60 * Vector3d(x.y(), -x.y(), 0), Vector3d(0, 0, 40 * (i % 3)));
      }
    specimen.advance(600);
    return specimen;
  }

  /** Loose spheres fall onto a floor and onto each other, with friction. */
  dem::Specimen falling_grains()
  {
    const dem::LinearContactParameters rough   = grains::rough();
    dem::Packing                       packing = cluster::cubic_lattice(6, 6, 6, 1e-3);
    dem::UniformRandom                 random(3);
    for (Vector3d &x : packing.centre)
      x = 1.02 * x + Vector3d(0, 0, 1.1e-3) + 2e-5 * cluster::random_vector(random);
    dem::Specimen          specimen(packing, grains::falling(), rough);
    dem::SurfaceParameters floor;
    floor.name = "floor";
    floor.mesh =
      dem::box(Vector3d(-0.05, -0.05, 0), Vector3d(0.05, 0.05, 1), {false, false, false, false, true, false});
    floor.contact = rough;
    specimen.surfaces().add(floor);
    for (std::size_t i = 0; i < packing.size(); ++i)
      specimen.set_velocity(i, Vector3d(0.3, 0, -1), Vector3d::Zero());
    specimen.advance(2000);
    return specimen;
  }

  struct Run
  {
    const char *name;
    dem::Specimen (*specimen)();
    std::uint64_t committed;
  };
} // namespace

TEST_CASE("four runs end in the committed bits on every processor, with every compiler and for any threads", "[dem]")
{
  for (const Run &run : {Run{"concrete in a cell", concrete_in_cell, 0x065c48b7605c4d35},
                         Run{"cemented cluster", cemented_cluster, 0x57a69d46f03fbbad},
                         Run{"jointed discs", jointed_discs, 0x38c40593df7397a0},
                         Run{"falling grains", falling_grains, 0x34bdd41d2654da7f}})
    for (const int threads : {1, 3})
      {
        INFO(run.name << ", " << threads << " threads, vectors of " << dem::bytes_of_kernel_vectors() << " bytes");
        omp_set_num_threads(threads);
        CHECK(fingerprint_of(run.specimen()) == run.committed);
      }
  omp_set_num_threads(1);
}
