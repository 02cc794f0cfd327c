#include "dem/loading/periodic_cell.h"

#include "base/errors.h"
#include "base/voigt.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace dem
{
  namespace
  {
    constexpr double       least_servo_steps   = 10; ///< T in time steps: stress is known one step late
    constexpr std::int64_t steps_between_looks = 10; ///< at what has come to touch in a cell that did not hold together

    const char *const component_names[6] = {"11", "22", "33", "23", "31", "12"};

    bool in_plane(const int component) { return component == 0 || component == 1 || component == 5; }

    void check(const CellTestParameters &p, const int dimension)
    {
      const auto refuse = [](const std::string &message) { throw base::InputError("Loading/" + message); };
      if (p.path.empty())
        refuse("path: at least one leg is needed.");
      if (!(p.servo_time > 0))
        refuse("servo time: must be above 0.");
      if (!(p.strain_limit > 0))
        refuse("strain limit: must be above 0.");
      if (!(p.localised_above > 0 && p.localised_above < 1))
        refuse("localised above: must lie between 0 and 1.");
      for (std::size_t i = 0; i < p.path.size(); ++i)
        {
          const std::string name = "path, leg " + std::to_string(i + 1) + ": ";
          if (!(p.path[i].duration > 0) || !std::isfinite(p.path[i].duration))
            refuse(name + "its duration must be above 0 s.");
          if (!p.path[i].target.allFinite())
            refuse(name + "its targets must be finite numbers.");
          for (int c = 0; c < 6; ++c)
            if (dimension == 2 && !in_plane(c) && (p.path[i].stress_given[c] || p.path[i].target[c] != 0))
              refuse(name + "component " + component_names[c] + " does not exist in two dimensions.");
        }
    }
  } // namespace

  bool StressAtEnd::missed() const
  {
    constexpr double of_itself = 0.5, of_largest = 0.05;
    return requested != 0 && std::abs(is - requested) > of_itself * std::abs(requested) &&
           std::abs(is - requested) > of_largest * largest;
  }

  bool StressAtEnd::inaccurate() const { return requested != 0 && std::abs(is - requested) > 0.1 * largest; }

  CellTest::CellTest(Specimen &body, const CellTestParameters &p)
    : specimen(&body)
    , parameters(p)
    , stiffness(body)
    , servo_constant(std::max(p.servo_time * stiffness.crossing_time(), least_servo_steps * body.time_step()))
    , watch(p.localised_above)
  {
    check(p, body.parameters().physics.dimension);
    begin_leg();
  }

  void CellTest::begin_leg()
  {
    const CellLeg      &now      = parameters.path[leg];
    const base::Vector6 measured = stress();
    for (int c = 0; c < 6; ++c)
      if (!now.stress_given[c])
        start[c] = strain[c];
      else
        start[c] =
          leg > 0 && parameters.path[leg - 1].stress_given[c] ? parameters.path[leg - 1].target[c] : measured[c];
    step_of_leg  = 0;
    steps_of_leg = std::max<std::int64_t>(1, std::llround(now.duration / specimen->time_step()));
  }

  base::Vector6 CellTest::requested(const std::int64_t step) const
  {
    const double part = static_cast<double>(step) / static_cast<double>(steps_of_leg);
    return step == steps_of_leg ? parameters.path[leg].target :
                                  base::Vector6(start + part * (parameters.path[leg].target - start));
  }

  base::Vector6 CellTest::stress() const { return base::stress_voigt(specimen->cell().stress); }

  /** Strains of the next step. */
  base::Vector6 CellTest::servo(const base::Vector6 &now, const base::Vector6 &next) const
  {
    std::vector<int> given; // components of given stress
    for (int c = 0; c < 6; ++c)
      if (parameters.path[leg].stress_given[c])
        given.push_back(c);
    base::Vector6 result = strain;
    for (int c = 0; c < 6; ++c)
      if (!parameters.path[leg].stress_given[c])
        result[c] = next[c];
    if (given.empty())
      return result;

    const base::Vector6 foretold = stiffness.value() * (result - strain); // by the imposed strains
    const base::Vector6 measured = stress();
    const auto          unknowns = static_cast<Eigen::Index>(given.size());
    Eigen::MatrixXd     K(unknowns, unknowns);
    Eigen::VectorXd     wanted(unknowns);
    for (Eigen::Index i = 0; i < unknowns; ++i)
      {
        const int c = given[i];
        wanted[i] = (next[c] - now[c]) - foretold[c] + specimen->time_step() / servo_constant * (now[c] - measured[c]);
        for (Eigen::Index j = 0; j < unknowns; ++j)
          K(i, j) = stiffness.value()(c, given[j]);
      }
    const Eigen::VectorXd change = K.ldlt().solve(wanted);
    for (Eigen::Index i = 0; i < unknowns; ++i)
      result[given[i]] += change[i];
    return result;
  }

  void CellTest::step()
  {
    const double dt = specimen->time_step();
    if (specimen->steps() % steps_between_looks == 0)
      stiffness.follow(*specimen);
    const base::Vector6 now = requested(step_of_leg), next = requested(step_of_leg + 1);
    const base::Vector6 to = servo(now, next);
    for (int c = 0; c < 6; ++c)
      if (parameters.path[leg].stress_given[c] && !(std::abs(to[c]) <= parameters.strain_limit))
        return end_at_limit(c);
    const Eigen::Matrix3d one = Eigen::Matrix3d::Identity();
    Eigen::Matrix3d gradient  = ((one + base::strain_tensor(to)) * specimen->cell().deformation.inverse() - one) / dt;
    if (specimen->parameters().physics.dimension == 2)
      {
        gradient.row(2).setZero(); // round-off of the inverse
        gradient.col(2).setZero();
      }
    specimen->set_velocity_gradient(gradient);
    aim           = now;
    aim_is_stress = parameters.path[leg].stress_given;
    specimen->advance(1);
    strain = to;
    if (++step_of_leg == steps_of_leg)
      end_leg();
  }

  void CellTest::stand_still()
  {
    specimen->set_velocity_gradient(Eigen::Matrix3d::Zero());
    aim           = requested(step_of_leg);
    aim_is_stress = parameters.path[leg].stress_given;
    specimen->advance(1);
  }

  StressAtEnd CellTest::stress_at_end(const std::int64_t component) const
  {
    StressAtEnd end;
    end.leg       = leg;
    end.component = component;
    end.requested = aim[component];
    end.is        = stress()[component];
    end.strain    = strain[component];
    for (std::size_t c = 0; c < 6; ++c)
      if (aim_is_stress[c])
        end.largest = std::max(end.largest, std::abs(aim[static_cast<Eigen::Index>(c)]));
    return end;
  }

  std::optional<StressAtEnd> CellTest::worst_at_end() const
  {
    const auto rank = [](const StressAtEnd &end) {
      return std::make_pair(end.missed(), std::abs(end.is - end.requested));
    };
    std::optional<StressAtEnd> worst;
    for (std::int64_t c = 0; c < 6; ++c)
      if (aim_is_stress[static_cast<std::size_t>(c)])
        if (const StressAtEnd end = stress_at_end(c); !worst || rank(end) > rank(*worst))
          worst = end;
    return worst;
  }

  void CellTest::end_leg()
  {
    const bool is_last = leg + 1 == static_cast<std::int64_t>(parameters.path.size());
    const auto before  = worst_at_end();
    if (is_last || (before && before->missed()))
      stand_still();
    if (const auto worst = worst_at_end())
      ends.push_back(*worst);
    if (!not_reached() && ++leg < static_cast<std::int64_t>(parameters.path.size()))
      begin_leg();
  }

  void CellTest::end_at_limit(const std::int64_t component)
  {
    stand_still();
    ends.push_back(stress_at_end(component));
    ends.back().at_limit = true;
  }

  CellSample CellTest::advance(const std::int64_t steps)
  {
    for (std::int64_t s = 0; s < steps && !finished(); ++s)
      step();
    CellSample now = sample();
    watch_for_localisation(now);
    samples.push_back(now);
    return now;
  }

  CellSample CellTest::sample() const
  {
    const CellState       cell = specimen->cell();
    const Eigen::Matrix3d skew = 0.5 * (cell.stress - cell.stress.transpose());
    CellSample            s;
    s.time        = specimen->time() - specimen->time_step(); // forces are those of the last step's start
    s.strain      = base::strain_voigt(cell.deformation_at_forces - Eigen::Matrix3d::Identity());
    s.stress      = base::stress_voigt(cell.stress);
    s.skew_stress = skew.cwiseAbs().maxCoeff();
    s.servo_error = 0;
    for (int c = 0; c < 6; ++c)
      if (aim_is_stress[c])
        s.servo_error = std::max(s.servo_error, std::abs(s.stress[c] - aim[c]));
    s.unbalanced = specimen->unbalanced_ratio();
    s.dissipated = specimen->energy().damage;
    s.localised  = found.has_value();
    return s;
  }

  void CellTest::watch_for_localisation(CellSample &now)
  {
    if (const std::optional<Band> band = watch.update(*specimen, {now.strain, now.stress, now.dissipated}))
      {
        now.localised = true;
        found         = Localisation{samples[static_cast<std::size_t>(*watch.onset())], now, *band};
      }
  }

  namespace
  {
    constexpr std::size_t numbers_per_sample = 18;

    void put(const CellSample &s, base::Column &flat)
    {
      flat.push_back(s.time);
      flat.insert(flat.end(), s.strain.data(), s.strain.data() + 6);
      flat.insert(flat.end(), s.stress.data(), s.stress.data() + 6);
      flat.insert(flat.end(), {s.skew_stress, s.servo_error, s.unbalanced, s.dissipated, s.localised ? 1.0 : 0.0});
    }

    CellSample sample_from(const double *flat)
    {
      return {flat[0],     base::Vector6(flat + 1), base::Vector6(flat + 7), flat[13], flat[14], flat[15], flat[16],
              flat[17] > 0};
    }

    void put(const Band &b, base::Column &flat)
    {
      flat.insert(flat.end(), b.wave.begin(), b.wave.end());
      flat.insert(flat.end(), b.normal.data(), b.normal.data() + 3);
      flat.insert(flat.end(), {b.concentration, b.place, b.period, b.thickness, b.by_chance, b.participation});
    }

    void visit_ends(base::StateVisitor &visitor, std::vector<StressAtEnd> &ends)
    {
      constexpr std::size_t numbers_per_end = 7;
      base::Column          flat;
      for (const StressAtEnd &e : ends)
        flat.insert(flat.end(), {static_cast<double>(e.leg), static_cast<double>(e.component), e.requested, e.is,
                                 e.strain, e.largest, e.at_limit ? 1.0 : 0.0});
      visitor.column("cell_test/stresses_at_ends", flat);
      ends.clear();
      for (std::size_t i = 0; i < flat.size(); i += numbers_per_end)
        ends.push_back({static_cast<std::int64_t>(flat[i]), static_cast<std::int64_t>(flat[i + 1]), flat[i + 2],
                        flat[i + 3], flat[i + 4], flat[i + 5], flat[i + 6] > 0});
    }

    Band band_from(const double *flat)
    {
      Band b;
      for (int c = 0; c < 3; ++c)
        b.wave[c] = static_cast<int>(flat[c]);
      b.normal = Eigen::Vector3d(flat + 3);
      std::tie(b.concentration, b.place, b.period, b.thickness, b.by_chance, b.participation) =
        std::tie(flat[6], flat[7], flat[8], flat[9], flat[10], flat[11]);
      return b;
    }
  } // namespace

  void CellTest::visit_state(base::StateVisitor &visitor)
  {
    visitor.scalar("cell_test/leg", leg);
    visitor.scalar("cell_test/step_of_leg", step_of_leg);
    visitor.scalar("cell_test/steps_of_leg", steps_of_leg);
    stiffness.visit_state(visitor);
    visit_ends(visitor, ends);
    base::Column numbers;
    for (const base::Vector6 *v : {&strain, &start, &aim})
      numbers.insert(numbers.end(), v->data(), v->data() + 6);
    for (const bool is_stress : aim_is_stress)
      numbers.push_back(is_stress ? 1.0 : 0.0);
    visitor.column("cell_test/numbers", numbers);
    strain = base::Vector6(numbers.data());
    start  = base::Vector6(numbers.data() + 6);
    aim    = base::Vector6(numbers.data() + 12);
    for (int c = 0; c < 6; ++c)
      aim_is_stress[c] = numbers[18 + c] > 0;

    base::Column curve;
    for (const CellSample &s : samples)
      put(s, curve);
    visitor.column("cell_test/curve", curve);
    samples.clear();
    for (std::size_t i = 0; i < curve.size(); i += numbers_per_sample)
      samples.push_back(sample_from(&curve[i]));

    watch.visit_state(visitor);
    base::Column events; // onset | detected | band
    if (found)
      {
        put(found->onset, events);
        put(found->detected, events);
        put(found->band, events);
      }
    visitor.column("cell_test/localisation", events);
    found.reset();
    if (!events.empty())
      found = Localisation{sample_from(events.data()), sample_from(&events[numbers_per_sample]),
                           band_from(&events[2 * numbers_per_sample])};
  }
} // namespace dem
