#pragma once

#include "apps/results/run_state.h"
#include "apps/runs/continuum/probe_column.h"
#include "apps/runs/continuum/solid_nodes.h"
#include "apps/runs/coupled/model.h"
#include "apps/runs/particles/body.h"
#include "postprocess/files/series.h"

#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace apps
{
  /** Steps that both sides take now. */
  struct CoupledSteps
  {
    double window = 0, solid = 0, particles = 0; ///< what is taken; what either side could take alone [s]
    int    particle_steps = 1;                   ///< in what is taken
    int    solid_steps    = 1;                   ///< likewise
  };

  /** On particles, by their number in the packing, and on nodes of the solid. */
  struct OutsideForces
  {
    struct Push
    {
      Eigen::Vector3d force = Eigen::Vector3d::Zero(), couple = Eigen::Vector3d::Zero(); ///< [N, N m]
    };
    std::map<std::size_t, Push>            particles;
    std::map<std::size_t, Eigen::Vector3d> nodes; ///< [N]
  };

  /** A solid and particles that touch, as a run drives and records them; whatever the dimension. */
  class CoupledBody
  {
  public:
    virtual ~CoupledBody() = default;

    /** Before the first step. @throws base::InputError for particles that lie in the solid, as well */
    virtual StaticStart start() = 0;

    /** At least one window, up to this time and so many at most; fewer when interrupted. @throws StoppedShort, base::NumericalError */
    virtual void advance_to(double time, std::int64_t most = std::numeric_limits<std::int64_t>::max()) = 0;
    /** So many windows. */
    virtual void advance(std::int64_t windows) = 0;

    virtual std::vector<postprocess::SeriesColumn> columns() const = 0; ///< of the series; the first is the time
    virtual std::vector<double>                    row()           = 0;
    /** Note the energies of the last row. @throws StoppedShort as EnergyWatch */
    virtual void watch() = 0;
    /** Columns that the summary reports, with their units. */
    virtual std::vector<postprocess::SeriesColumn> reported() const = 0;

    /** Forces from outside, beside the scene's, until the next call. No checkpoint holds them. */
    virtual void push(const OutsideForces &forces) = 0;

    virtual ParticlesBody       &particles()       = 0;
    virtual const ParticlesBody &particles() const = 0;
    virtual SolidNodes          &nodes()           = 0; ///< of the solid
    virtual const SolidNodes    &nodes() const     = 0;
    virtual double               time() const      = 0; ///< [s]
    virtual CoupledSteps         steps() const     = 0;
    /** Of the solid, as far as waves come in a time [s] from a place on its surface, at most all of it [kg]. */
    virtual double                solid_mass_within(double time) const = 0;
    virtual std::size_t           elements() const                     = 0;
    virtual std::size_t           unknowns() const                     = 0;
    virtual std::int64_t          windows() const                      = 0; ///< taken
    virtual std::int64_t          windows_taken_back() const           = 0; ///< and taken again with fewer steps
    virtual const ContactFigures &interface() const                    = 0;
    /** What the impedances of particles and solid reflect, whatever joins them; "" where the medium is not known. */
    virtual std::string text_of_mismatch() const = 0;
    /** Lines of a forecast: where particles lie inside the solid. */
    virtual std::string text_of_handshakes() const = 0;

    /** @param number of the snapshot. @throws postprocess::OutputError */
    virtual void write_solid(const std::filesystem::path &folder, std::size_t number) = 0;

    /** What a user should know of the solid's points, one sentence each. */
    virtual std::vector<std::string> notes() const = 0;
    /** What a user should doubt: how particles lie inside the solid, what couplings have lost; likewise. */
    virtual std::vector<std::string> doubts() const = 0;
    /** Why no state after this one is worth anything; "": none. */
    virtual std::string end_of_validity() const = 0;

    /** Draw which cells of particles behind points of the solid have taken over, and when. @return as draw() */
    virtual std::string draw_promotion(const std::filesystem::path &file, const std::string &title) = 0;

    /** Draw the damage of the solid, where its materials can be damaged. @return as draw() */
    virtual std::string draw_damage(const std::filesystem::path &file, const std::string &title) = 0;

    /** Draw a cut through both, as they are now. @param particles of the specimen @return what went wrong, "" if nothing */
    virtual std::string
    draw(const std::filesystem::path &file, const std::string &title, const dem::ParticleOutput &particles) const = 0;

    /**
     * Draw a slab of bonded particles coloured by damage, and their cracks, with the solid beside; displacements magnified.
     * @param links of the specimen that are damaged @return as draw()
     */
    virtual std::string draw_cracks(const std::filesystem::path &file,
                                    const std::string           &title,
                                    const dem::ParticleOutput   &particles,
                                    const dem::LinkOutput       &links) const = 0;

    /** A reader must have been made from the same model and packing. */
    virtual void visit_state(RunState &state) = 0;
  };

  /**
   * @param packing as CoupledModel::packing() makes it; both outlive the body. @param media of its particles, where they are known
   * @throws base::InputError
   */
  std::unique_ptr<CoupledBody>
  make_coupled_body(const CoupledModel &model, const dem::Packing &packing, const ParticleMedia &media = {});
} // namespace apps
