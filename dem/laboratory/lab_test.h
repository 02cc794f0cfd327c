#pragma once

#include "dem/laboratory/cylinder_wall.h"
#include "dem/laboratory/membrane.h"
#include "dem/laboratory/particle_gauges.h"
#include "dem/laboratory/press.h"
#include "dem/laboratory/side_walls.h"
#include "dem/laboratory/test_figures.h"
#include "dem/laboratory/test_record.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace dem
{
  /** A test of a laboratory on a specimen (doc/theory/laboratory.md). */
  struct LabParameters
  {
    enum class Test
    {
      compression, ///< uniaxial, between platens
      tension,     ///< direct, by glued platens
      splitting,   ///< of a disk across its diameter (Brazilian)
      bending,     ///< of a beam on two supports, by a roller in the middle
      confined     ///< compression under a pressure across: biaxial in the plane, triaxial in space
    };
    enum class Confinement
    {
      walls,
      membrane,
      cylinder ///< a rigid jacket around a cylinder of spheres
    };

    Test            test = Test::compression;
    PressParameters press;             ///< its kind follows from the test
    double          speed      = 0;    ///< of both sides towards each other, or apart [m/s], > 0
    std::int64_t    ramp_steps = 1000; ///< over which the speed grows from zero

    double       seating_stress = 0;      ///< to which the platens come to sit before the loading [Pa]; 0: they do not
    double       seating_speed  = 0;      ///< [m/s]; 0: the speed
    double       rest           = 1e-5;   ///< force ratio that counts as at rest, after seating and confining
    std::int64_t rest_steps     = 100000; ///< at most that are waited for it

    std::optional<double> section; ///< across the axis, of specimens with one [m^2]; none: as a calliper finds it

    Confinement  confinement   = Confinement::walls;
    double       pressure      = 0;   ///< across, and along as long as the test has not begun [Pa], > 0
    double       largest_speed = 0;   ///< of servo walls [m/s]; 0: the speed
    double       gain          = 0.1; ///< of servos
    double       ball = 0; ///< radius of the ball that finds a membrane's particles [m]; 0: half a mean diameter
    std::int64_t membrane_steps = 200; ///< after which the membrane is laid anew

    double stop_fraction = 0.7; ///< of the peak, past which the test ends once the stress is below; 0: never
    double stop_strain   = 0;   ///< [-], > 0
  };

  /**
   * Takes a specimen through a test and records it: forces of every step, the rest every so many. Around each step drive() comes before
   * and observe() after it. The specimen must outlive the test.
   */
  class LabTest
  {
  public:
    enum class Stage : std::int64_t
    {
      confining, ///< the pressure comes on
      seating,   ///< the platens come to sit
      settling,  ///< everything comes to rest
      loading,
      done
    };

    /** Before the first step: adds platens, walls or glue. @throws base::InputError naming the entry of section Laboratory */
    LabTest(Specimen &specimen, const LabParameters &parameters);

    /** Load at another speed from now on, a part of the prescribed one. No part of the state. */
    void change_speed(const double part) { what.speed *= part; }

    /** What the next step does. Calling it again changes nothing. */
    void drive();
    /** Whether drive() pushes particles (Specimen::add_force()): clear_forces() before it. */
    bool pushes() const { return membrane.has_value(); }
    void observe();

    /** How long the loading takes at most: to the largest strain [s]. */
    double longest_loading() const;
    /** How far it has come on that way, in [0, 1]. */
    double done() const;

    Stage                    stage() const { return now; }
    bool                     finished() const { return now == Stage::done; }
    const LabReading        &reading() const { return last; } ///< of the last step; what is dear of the last row
    const TestRecord        &record() const { return rows; }
    TestFigures              figures() const;
    QuasiStatic              how_static() const { return quasi_static(curve()); }
    bool                     past_peak() const; ///< the largest stress is known to be the peak
    std::vector<std::string> notes() const;     ///< what casts doubt on the figures
    double                   stress_of_force() const { return stress_per_force; } ///< [1/m^2]
    double                   work() const;        ///< of the platens since the loading began [J]
    double                   friction() const;    ///< dissipated by sliding since the start, of bonds and contacts [J]
    double                   stress_left() const; ///< over the largest [-]
    double fracture_area() const { return area; } ///< section that breaks, of a disk D t, of a beam b d [m^2]
    double seated_strain() const { return seated; } ///< at the end of seating [-]
    const LabParameters &parameters() const { return what; }

    void visit_state(base::StateVisitor &visitor);

  private:
    bool is(const LabParameters::Test test) const { return what.test == test; }
    void choose_measures(const ParticleKinematics &particles, const BodyExtent &body);
    /** Speed of the step to come: the prescribed one, growing from zero [m/s]. */
    double       ramped(double speed) const;
    double       strain_now() const;      ///< by the platens, where they are now [-]
    double       pressure_now() const;    ///< that is prescribed [Pa]
    double       confinement_now() const; ///< as it is measured, mean of all sides [Pa]
    bool         sides_near_pressure() const;
    std::int64_t breaks() const { return static_cast<std::int64_t>(specimen->logged_breaks()); } ///< so far
    double       load() const { return last.stress - (is(LabParameters::Test::confined) ? what.pressure : 0.0); }
    double       gauge_strain() const;
    double       lateral_strain() const;
    /** Of what only rows hold. */
    void read_rest();
    void follow_load();
    void next_stage();
    /** Whether everything is at rest, and under the prescribed pressure; checked every now and then. */
    bool rests();
    /** Whether the gauges have hardly moved for as long as the specimen's slowest swing takes: forces do not show a steady drift. */
    bool      stands_still();
    bool      waited_enough() const { return stage_steps > what.ramp_steps + what.rest_steps; }
    void      enter(Stage stage);
    void      begin_loading();
    bool      test_ends() const;
    TestCurve curve() const;

    Specimen                   *specimen;
    LabParameters               what;
    Press                       press;
    std::optional<SideWalls>    walls;
    std::optional<CylinderWall> jacket;
    std::optional<Membrane>     membrane;
    double                      stress_per_force = 0, strain_per_approach = 0, area = 0; ///< [1/m^2], [1/m], [m^2]
    ParticleGauge               rows_gauge;
    std::vector<ParticleGauge>  side_gauges;
    MeanMotion                  middle_of_beam, left_support, right_support;
    std::int64_t                wave_steps = 0; ///< that a dip of the stress may last before it is a fall

    bool         bonded      = false; ///< there were bonds at the start
    Stage        now         = Stage::seating;
    std::int64_t stage_steps = 0; ///< taken in it
    double       approached  = 0; ///< where the loading's strain begins [m]
    double       worked      = 0; ///< from outside before the record began [J]
    double       next_strain = 0; ///< of the forces that the next step finds
    double       seated      = 0;
    double       peak = 0, strain_at_peak = 0;
    std::int64_t breaks_before = 0; ///< the loading
    std::int64_t low_steps     = 0,
                 fallen_steps  = 0; ///< since the stress has been below the stop fraction, and as low as after a peak
    LabReading   last;
    TestRecord   rows;
    double       gauge_zero = 0, lateral_zero = 0;     ///< strains of the gauges where the loading began
    double       gauge_before = 0, lateral_before = 0; ///< likewise, when it was last checked whether they move
    std::int64_t still_steps = 0;                      ///< for which they have hardly moved
    std::int64_t unconfined = 0, unsettled = 0,
                 unseated = 0; ///< 1: a stage ended without having come to what it should
  };
} // namespace dem
