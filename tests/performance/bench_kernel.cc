// Link updates per second of the kernels of every law, from the 50 mm cube to a million particles, beside the machine's own rates.
//
// Run:     build/release/tests/performance/bench_kernel [particles ...]      (a minute; default 14556 100000 1000000)
//          build/release/tests/performance/bench_kernel --elastic FILE PARTICLES    for beside_yade.sh: writes the packing to FILE as
//          x y z radius [m], prints links and elastic link updates per second of
//          processor time, on one thread
// Expect:  the roofline of one link update, then a row per size, state and number of threads; instructions per link are of whole
//          steps of 400 particles on one thread, and do not depend on what else the machine does
//
// Whole steps of dem::Specimen are timed: link pass, particle pass, accounts, search for contacts. Rotations, damage, friction,
// contacts and the exactly objective shear update are on.
#include "dem/core/kernel_vectors.h"
#include "dem/laws/contact_bond.h"
#include "dem/laws/cpm.h"
#include "dem/laws/flat_joint.h"
#include "dem/laws/hertz_mindlin.h"
#include "dem/laws/linear_contact.h"
#include "dem/laws/parallel_bond.h"
#include "dem/packing/compaction.h"
#include "dem/packing/lattice.h"
#include "dem/packing/tiling.h"
#include "dem/specimen/specimen.h"
#include "instruction_count.h"
#include "machine_rates.h"
#include "operation_count.h"
#include "tests/dem/clusters.h"

#include <omp.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

namespace
{
  /** How hard the links work while they are timed. */
  enum class State
  {
    elastic,         ///< below the onset of damage
    softening,       ///< every link stretched past it and further at every step: the exponential is evaluated for all
    materials,       ///< elastic, and every other particle of a second material: each link gathers its constants
    cemented,        ///< links with moments: linear parallel bonds below their strength
    glued,           ///< contact bonds below their strength
    touching,        ///< linear contacts, pressed
    elastic_spheres, ///< contacts after Hertz and Mindlin with a dashpot, pressed
    jointed,         ///< flat joints of four elements, all bonded
    slit             ///< flat joints of four elements, none bonded: each is visited
  };

  const char *name_of(const State state)
  {
    switch (state)
      {
      case State::elastic:
        return "elastic";
      case State::softening:
        return "softening";
      case State::materials:
        return "two materials";
      case State::cemented:
        return "parallel bond";
      case State::glued:
        return "contact bond";
      case State::touching:
        return "linear contact";
      case State::elastic_spheres:
        return "hertz-mindlin";
      case State::jointed:
        return "flat joint";
      case State::slit:
        return "flat joint, slit";
      }
    return "";
  }

  /** Of a law with bonds; none breaks. */
  template <typename Parameters>
  Parameters unbreakable()
  {
    Parameters p;
    p.effective_modulus    = 25e9;
    p.friction_coefficient = 0.8;
    p.tensile_strength     = 1e9;
    p.cohesion             = 1e9;
    return p;
  }

  dem::LinearContactParameters grains()
  {
    dem::LinearContactParameters p;
    p.effective_modulus    = 25e9;
    p.friction_coefficient = 0.8;
    return p;
  }

  dem::HertzMindlinParameters glass()
  {
    dem::HertzMindlinParameters p;
    p.young_modulus        = 25e9;
    p.friction_coefficient = 0.8;
    p.restitution          = 0.8;
    return p;
  }

  dem::FlatJointParameters joints(const bool slit)
  {
    auto p          = unbreakable<dem::FlatJointParameters>();
    p.elements      = 4;
    p.rings         = 1;
    p.sectors       = 4;
    p.slit_fraction = slit ? 1 : 0;
    return p;
  }

  dem::LinkMaterials materials_in(const State state, const dem::CpmMaterials &concretes)
  {
    switch (state)
      {
      case State::cemented:
        return unbreakable<dem::ParallelBondParameters>();
      case State::glued:
        return unbreakable<dem::ContactBondParameters>();
      case State::touching:
        return grains();
      case State::elastic_spheres:
        return glass();
      case State::jointed:
      case State::slit:
        return joints(state == State::slit);
      default:
        return concretes;
      }
  }

  /** The periodic cell of the uniaxial scene, repeated and cropped to a cube of about the given number of particles. */
  dem::Packing cube(const dem::Packing &cell, const double particles)
  {
    const double per_volume = static_cast<double>(cell.size()) / cell.periodic_cell->prod();
    return dem::tile_and_crop(cell, Eigen::Vector3d::Constant(std::cbrt(particles / per_volume))).packing;
  }

  bool flat(const dem::Packing &packing)
  {
    return std::all_of(packing.centre.begin(), packing.centre.end(),
                       [](const Eigen::Vector3d &x) { return x.z() == 0; });
  }

  /** Nearer together by a hundredth, so that neighbours press each other. */
  dem::Packing pressed(dem::Packing packing)
  {
    for (Eigen::Vector3d &centre : packing.centre)
      centre *= 0.99;
    return packing;
  }

  /** Particles near the edges stay where they are, and the rest between them. */
  void hold_edges(dem::Specimen &specimen, const dem::Packing &packing, const bool plane)
  {
    Eigen::Vector3d low = packing.centre.front(), high = low;
    for (const Eigen::Vector3d &centre : packing.centre)
      {
        low  = low.cwiseMin(centre);
        high = high.cwiseMax(centre);
      }
    dem::Grip edges;
    edges.prescribed = {true, true, !plane};
    for (std::size_t i = 0; i < packing.size(); ++i)
      {
        const double width = 3 * packing.radius[i];
        for (int c = 0; c < (plane ? 2 : 3); ++c)
          if (packing.centre[i][c] < low[c] + width || packing.centre[i][c] > high[c] - width)
            {
              edges.particles.push_back(i);
              break;
            }
      }
    specimen.grips().add(edges);
  }

  dem::Specimen specimen_in(const State state, const dem::Packing &packing)
  {
    dem::SpecimenParameters parameters;
    parameters.density           = 4800;
    parameters.interaction_ratio = 1.5;
    parameters.damping           = 0.3;
    const bool        contacts   = state == State::touching || state == State::elastic_spheres;
    dem::Packing      particles  = contacts ? pressed(packing) : packing;
    dem::CpmMaterials materials  = cluster::concrete();
    if (state == State::materials)
      {
        materials.list.push_back(materials.list.front());
        for (std::size_t i = 0; i < packing.size(); ++i)
          particles.material.push_back(static_cast<std::int32_t>(i % 2));
      }
    const bool plane = flat(packing);
    if (plane)
      {
        parameters.physics.dimension = 2;
        parameters.thickness         = 1e-3;
        parameters.interaction_ratio = 1.1;
        particles.periodic_cell.reset();
      }
    dem::Specimen specimen(particles, parameters, materials_in(state, materials));
    // A uniform expansion: the lower strain rate stays elastic for the steps timed; the higher one is past the onset of damage in
    // every link before they begin, and far from breaking one when they end.
    // Joints of which nothing is bonded are pressed together instead, and contacts lie pressed between held edges.
    const double rate = state == State::softening ? 100.0 : state == State::slit ? -1e-2 : 1e-2;
    for (std::size_t i = 0; i < packing.size(); ++i)
      specimen.set_velocity(i, rate * packing.centre[i],
                            plane ? Eigen::Vector3d(0, 0, 0.5) : Eigen::Vector3d(1.0, -2.0, 0.5));
    if (contacts)
      hold_edges(specimen, particles, plane);
    return specimen;
  }

  /** Of one thread, per link and step: what a busy machine does not blur. 0 where they cannot be counted. */
  double instructions_per_update(dem::Specimen specimen)
  {
    omp_set_num_threads(1);
    specimen.advance(20);
    const double links = static_cast<double>(specimen.counts().links + specimen.counts().contacts);
    return performance::instructions_of([&] { specimen.advance(1); }) / links;
  }

  double wall_seconds()
  {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  }

  /** Of all threads together. */
  double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

  /**
   * Best of three runs [link updates/s]; the best is the one least disturbed. One thread is timed by its processor time, which other
   * programs disturb less.
   */
  double updates_per_second(dem::Specimen &specimen, const int threads)
  {
    double (*const seconds)() = threads == 1 ? processor_seconds : wall_seconds;
    omp_set_num_threads(threads);
    specimen.advance(20);
    const double links = static_cast<double>(specimen.counts().links + specimen.counts().contacts);
    const auto   steps = static_cast<std::int64_t>(std::max(4.0, 8e6 / links));
    double       best  = 0;
    for (int run = 0; run < 3; ++run)
      {
        const double start = seconds();
        specimen.advance(steps);
        best = std::max(best, links * static_cast<double>(steps) / (seconds() - start));
      }
    return best;
  }

  /**
   * Bytes that a link update moves between memory and core when no column stays in a cache, for a link's share of particles.
   *
   * Link: read two ends, L0, A, kappa, omega, three shears; write the shears; write the force record (past the caches: it is not read
   * first), read it at both ends. Particle: read both records of the pass, then pose and velocity read and written, motion and force
   * written (likewise), inverse mass, mass, inertia, tables read.
   */
  double bytes_per_update(const double links_per_particle)
  {
    const double link     = 2 * 4 + 4 * 8 + 3 * 8 + 3 * 8 + 64 + 2 * 64 + 4;
    const double particle = 2 * 64 + 2 * (64 + 64) + 2 * 64 + 64 + 2 * 8 + 2 * 4;
    return link + particle / links_per_particle;
  }

  void print_roofline(const int most_threads, const double links_per_particle)
  {
    const performance::Operations o = performance::count_link_update();
    std::printf("Kernels of %d bits. One link update: %ld operations (%ld + or -, %ld *, %ld /, %ld sqrt, %ld "
                "comparisons), %.0f bytes if "
                "nothing stays in a cache\n\n",
                8 * dem::bytes_of_kernel_vectors(), o.all(), o.additions, o.multiplications, o.divisions, o.roots,
                o.comparisons, bytes_per_update(links_per_particle));
    std::printf("| threads | triad GB/s | read GB/s | multiply-adds Gop/s | bound by memory M/s | bound by arithmetic "
                "M/s |\n|---|---|---|---|---|---|\n");
    for (int threads = 1; threads <= most_threads; threads *= 2)
      {
        const double triad = performance::triad_bandwidth(threads), read = performance::read_bandwidth(threads),
                     rate = performance::arithmetic_rate(threads);
        std::printf("| %d | %.1f | %.1f | %.1f | %.1f | %.1f |\n", threads, 1e-9 * triad, 1e-9 * read, 1e-9 * rate,
                    1e-6 * read / bytes_per_update(links_per_particle), 1e-6 * rate / static_cast<double>(o.all()));
      }
    std::printf("\n");
  }

  /** @param few a part of the packing, on which instructions are counted */
  void print_case(const dem::Packing       &packing,
                  const dem::Packing       &few,
                  const int                 most_threads,
                  const std::vector<State> &states)
  {
    for (const State state : states)
      {
        const double  instructions = instructions_per_update(specimen_in(state, few));
        dem::Specimen specimen     = specimen_in(state, packing);
        double        alone        = 0;
        for (int threads = 1; threads <= most_threads; threads *= 2)
          {
            const double      rate   = updates_per_second(specimen, threads);
            const dem::Counts counts = specimen.counts();
            alone                    = threads == 1 ? rate : alone;
            std::printf("| %zu | %zu | %s | %d | %.1f | %.1f | %.2f | %.0f | %.1f |\n", counts.particles,
                        counts.links + counts.contacts, name_of(state), threads, 1e-6 * rate, 1e9 / rate, rate / alone,
                        static_cast<double>(specimen.bytes()) / static_cast<double>(counts.links + counts.contacts),
                        instructions);
            std::fflush(stdout);
          }
      }
  }

  /** Of 1000 spheres of 1 mm, as the uniaxial scene has them. */
  dem::Packing periodic_cell()
  {
    dem::CompactionParameters parameters;
    parameters.radius   = 1e-3;
    parameters.count    = 1000;
    parameters.seed     = 1;
    parameters.friction = 0.5;
    parameters.damping  = 0.6;
    return dem::compact(parameters).packing;
  }

  /** For another program beside this one: the packing, and what this one does with it. */
  int print_elastic(const char *file, const double particles)
  {
    const dem::Packing packing = cube(periodic_cell(), particles);
    std::FILE *const   text    = std::fopen(file, "w");
    if (text == nullptr)
      {
        std::perror(file);
        return 2;
      }
    for (std::size_t i = 0; i < packing.size(); ++i)
      std::fprintf(text, "%.17g %.17g %.17g %.17g\n", packing.centre[i].x(), packing.centre[i].y(),
                   packing.centre[i].z(), packing.radius[i]);
    std::fclose(text);
    dem::Specimen specimen = specimen_in(State::elastic, packing);
    const double  rate     = updates_per_second(specimen, 1);
    std::printf("%zu %.6g\n", specimen.counts().links + specimen.counts().contacts, rate);
    return 0;
  }
} // namespace

int main(int argc, char **argv)
{
  if (argc == 4 && std::string(argv[1]) == "--elastic")
    return print_elastic(argv[2], std::atof(argv[3]));
  std::vector<double> sizes;
  for (int i = 1; i < argc; ++i)
    sizes.push_back(std::atof(argv[i]));
  if (sizes.empty())
    sizes = {14556, 1e5, 1e6};

  const dem::Packing cell         = periodic_cell();
  const int          most_threads = omp_get_max_threads();

  print_roofline(most_threads, 6.3);
  const std::string header = "| particles | links | state | threads | M link updates/s | ns per link | over one thread "
                             "| bytes per link | instructions "
                             "per link |\n|---|---|---|---|---|---|---|---|---|\n";
  std::printf("%s", header.c_str());
  const dem::Packing few = cube(cell, 400);
  for (const double size : sizes)
    print_case(cube(cell, size), few, most_threads,
               {State::elastic, State::softening, State::materials, State::cemented, State::glued, State::touching,
                State::elastic_spheres, State::jointed, State::slit});
  std::printf("\nDiscs in the plane:\n\n%s", header.c_str());
  const auto discs = [](const double count) {
    const int edge = static_cast<int>(std::sqrt(count));
    return dem::make_lattice(dem::Lattice::hexagonal, 1e-3, {edge, edge / 2, 1});
  };
  for (const double size : sizes)
    print_case(discs(size), discs(400), most_threads,
               {State::cemented, State::glued, State::touching, State::elastic_spheres, State::jointed, State::slit});
}
