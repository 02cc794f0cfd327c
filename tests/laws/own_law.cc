// A law that dem does not know, written here: kernel, statics, checkpoint, ParaView files and link-test take it as it is.
#include "dem/kernels/link_update.h"
#include "dem/laws/registry.h"
#include "dem/loading/link_path.h"
#include "dem/network/elastic_network.h"
#include "dem/specimen/specimen.h"
#include "dem/statics/quasi_static_path.h"
#include "postprocess/vtk/vtk_links.h"
#include "tests/apps/scratch_folder.h"
#include "tests/dem/memory_state.h"

#include <catch2/catch.hpp>
#include <vtkCellData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>

#include <cmath>
#include <limits>

using Eigen::Vector3d;

namespace
{
  struct RubberLaw;

  struct RubberParameters
  {
    using Law = RubberLaw;

    double modulus = 0, stiffening = 0;
    double largest_stretch = std::numeric_limits<double>::max();
  };

  template <typename Number>
  struct RubberNumbers
  {
    Number modulus, stiffening, largest_stretch;
  };

  struct RubberConstants : RubberNumbers<double>
  {
    explicit RubberConstants(const RubberParameters &p)
      : RubberNumbers{p.modulus, p.stiffening, p.largest_stretch}
    {
    }
  };

  /** A rubber band: sigma = E (eps + b eps^3), shear with E/3, snaps at its largest stretch; it remembers how far it was stretched. */
  struct Rubber : dem::LinkLawDefaults
  {
    using Constants                    = RubberConstants;
    static constexpr const char *name  = "rubber";
    static constexpr bool        bonds = true, moment = false, breaks_in_place = false;
    static constexpr int         records = 1;

    template <typename T, int m>
    using State = dem::LinkState<T, m, 1, 1, 0>;

    static std::array<dem::LinkQuantity, 2> history()
    {
      return {{{"stretch", "-", "largest strain so far", true}, {"shear", "-", "shear strain"}}};
    }
    static void put(const Constants &k, double *record)
    {
      record[0] = k.modulus, record[1] = k.stiffening, record[2] = k.largest_stretch;
    }
    static RubberNumbers<dem::Pack> gathered(const dem::Pack (&c)[1][8], const Constants &)
    {
      return {c[0][0], c[0][1], c[0][2]};
    }
    static double reference_length(const dem::NewLink &link) { return link.distance; }
    static void   begin(const Constants &, const dem::NewLink &, double *numbers) { numbers[0] = 0; }

    template <typename K, typename T, int m>
    static dem::LinkForce<T, m>
    update(const K &k, const dem::LinkMotion<T, m> &motion, State<T, m> &state, dem::LinkWork<T> &)
    {
      const T              e = motion.strain;
      dem::LinkForce<T, m> answer;
      answer.normal   = motion.area * (k.modulus * (e + k.stiffening * e * e * e));
      answer.shear    = (motion.area * T(k.modulus / 3.0)) * state.shear[0];
      state.number[0] = dem::maximum(state.number[0], e);
      answer.slides   = dem::Comparison<T>(false);
      answer.event    = state.number[0] > T(k.largest_stretch);
      return answer;
    }
    template <typename S>
    static unsigned changes_numbers(const S &, const S &)
    {
      return 1; // the stretch
    }
    template <typename S>
    static dem::LinkStiffnesses stiffness(const Constants &k, const dem::LinkGeometry &, const S &)
    {
      return {k.modulus, k.modulus / 3, 0, 0};
    }
    template <typename S>
    static dem::LinkStiffnesses damaged_stiffness(const Constants &k, const dem::LinkGeometry &, const S &)
    {
      return {k.modulus, k.modulus / 3, 0, 0};
    }
    template <typename S>
    static dem::LinkPhase phase(const Constants &k, const dem::LinkGeometry &, const S &state)
    {
      return state.number[0] > k.largest_stretch ? dem::LinkPhase::gone : dem::LinkPhase::whole;
    }
    template <typename S>
    static double stored(const Constants &k, const dem::LinkGeometry &link, const S &state)
    {
      const double e2 = link.strain * link.strain;
      return link.area * link.reference * k.modulus *
             (e2 / 2 + k.stiffening * e2 * e2 / 4 + dot(state.shear[0], state.shear[0]) / 6);
    }
    template <typename S>
    static dem::LinkLoss damage(const Constants &, const dem::LinkGeometry &, const S &)
    {
      return {};
    }
    template <typename S>
    static dem::LinkExertion exertion(const Constants &k, const dem::LinkGeometry &, const S &state, double, double)
    {
      return {state.number[0] / k.largest_stretch, 0};
    }
    static base::Matrix6 tangent(const Constants     &k,
                                 const dem::LinkStep &step,
                                 const State<double, 3> &,
                                 const State<double, 3> &,
                                 dem::LinkTangent)
    {
      const double          e  = step.geometry.strain;
      const Eigen::Matrix3d nn = step.direction * step.direction.transpose();
      base::Matrix6         C  = base::Matrix6::Zero();
      C.topLeftCorner<3, 3>() =
        k.modulus * ((1 + 3 * k.stiffening * e * e) * nn + (Eigen::Matrix3d::Identity() - nn) / 3);
      return C;
    }
  };

  struct RubberLaw
  {
    using Parameters                          = RubberParameters;
    static constexpr const char *name         = "rubber";
    static constexpr const char *meaning      = "Rubber band";
    static constexpr bool        touches_only = false;
    static Parameters            mean_of(const dem::Material<Parameters> &one, const dem::Material<Parameters> &)
    {
      return one.parameters;
    }
    static void check(const Parameters &) {}
    static std::shared_ptr<const dem::LinkLaw>
    bonds(const std::vector<Parameters> &pairs, const dem::Physics &physics, const int vectors)
    {
      return std::make_shared<dem::LinkLawOf<Rubber>>(std::vector<RubberConstants>(pairs.begin(), pairs.end()), vectors,
                                                      physics.rotations);
    }
    static std::shared_ptr<const dem::LinkLaw>
    contacts(const std::vector<Parameters> &pairs, const dem::Physics &physics, const int vectors)
    {
      return bonds(pairs, physics, vectors);
    }
    template <typename Number, typename Choice>
    static void describe(Parameters &p, Number &&number, Choice &&)
    {
      number("Modulus", p.modulus, "Pa", "E", 0.0, 1e300, true);
      number("Stiffening", p.stiffening, "-", "b", 0.0, 1e300, false);
      number("Largest stretch", p.largest_stretch, "-", "where it snaps", 0.0, 1e300, false);
    }
  };

  constexpr double r = 1e-3, E = 1e6, b = 1e3;

  RubberParameters band() { return {E, b}; }

  dem::SpecimenParameters parameters()
  {
    dem::SpecimenParameters p;
    p.density           = 1000;
    p.interaction_ratio = 1.1;
    p.physics.contacts  = false;
    return p;
  }

  dem::Packing row(const int n)
  {
    dem::Packing packing;
    for (int i = 0; i < n; ++i)
      packing.centre.push_back({2 * r * i, 0, 0});
    packing.radius.assign(static_cast<std::size_t>(n), r);
    return packing;
  }

  double stress(const double e) { return E * (e + b * e * e * e); }
} // namespace

TEST_CASE("a law of one's own runs in the kernel, with its energy, its breaks and its checkpoint", "[laws]")
{
  dem::Specimen pair(row(2), parameters(), band());
  const double  v = 0.05;
  pair.set_velocity(1, {v, 0, 0}, Vector3d::Zero());
  pair.set_velocity(0, {-v, 0, 0}, Vector3d::Zero());
  pair.advance(150);
  const dem::LinkOutput links = pair.links();
  REQUIRE(links.ends.size() == 1);
  CHECK(std::abs(links.normal_strain[0]) > 1e-3);
  CHECK(links.normal_stress[0] == Approx(stress(links.normal_strain[0])).epsilon(1e-12));
  CHECK(pair.energy().balance_error() < 2e-3);
  REQUIRE(links.quantities.size() == 1);
  CHECK(links.quantities[0].name == "stretch");
  CHECK(links.history[0][0] > 1e-3);

  MemoryState         memory;
  MemoryState::Writer writer(memory);
  pair.visit_state(writer);
  CHECK(memory.columns.count("bonds/stretch") == 1);
  dem::Specimen       resumed(row(2), parameters(), band());
  MemoryState::Reader reader(memory);
  resumed.visit_state(reader);
  pair.advance(50);
  resumed.advance(50);
  CHECK(resumed.links().normal_force[0] == pair.links().normal_force[0]);

  RubberParameters weak = band();
  weak.largest_stretch  = 1e-3;
  for (const double step_factor : {0.8, 0.05}) // the longer step passes the largest stretch before any force has acted
    {
      dem::SpecimenParameters p = parameters();
      p.step_factor             = step_factor;
      dem::Specimen snaps(row(2), p, weak);
      snaps.set_velocity(1, {2 * v, 0, 0}, Vector3d::Zero());
      snaps.advance(150);
      const dem::EnergyAccount energy = snaps.energy();
      CAPTURE(step_factor, energy.initial, energy.kinetic, energy.released);
      CHECK(snaps.counts().broken == 1);
      CHECK(energy.elastic == 0);
      CHECK(energy.balance_error() < 2e-3);
    }
}

TEST_CASE("a law of one's own is followed by the static solver along its nonlinear path", "[laws]")
{
  dem::NetworkParameters links;
  links.interaction_ratio     = 1.1;
  dem::ElasticNetwork network = dem::make_network(row(5), links, band());
  CHECK(network.links[0].stiffness(0, 0) == Approx(E * M_PI * r * r / (2 * r)));
  dem::GripPair grips;
  grips.axis                = 0;
  grips.layers.low          = {0};
  grips.layers.high         = {4};
  grips.layers.high_face    = 8 * r;
  grips.layers.distance     = 8 * r;
  grips.layers.gauge_length = 8 * r;
  grips.layers.section      = M_PI * r * r;
  grips.lateral_blocked = grips.spin_blocked = true;
  const dem::LoadedNetwork   loaded          = dem::load_grips(std::move(network), grips);
  dem::QuasiStaticParameters p;
  p.strain_step = 5e-3;
  p.end_strain  = 4e-2;
  p.tolerance   = 1e-9;
  dem::QuasiStaticPath path(loaded, band(), p);
  while (!path.finished())
    path.advance();
  REQUIRE(path.points().size() > 4);
  for (const dem::QuasiStaticPoint &point : path.points())
    CHECK(point.stress[0] == Approx(stress(point.strain[0])).epsilon(1e-6).margin(1e-6));
  CHECK(path.points().back().iterations < 8); // quadratic
}

TEST_CASE("a law of one's own is in ParaView files, in link-test and in the list of laws", "[laws]")
{
  const apps_tests::ScratchFolder folder;
  dem::Specimen                   pair(row(2), parameters(), band());
  pair.set_velocity(1, {0.05, 0, 0}, Vector3d::Zero());
  pair.advance(50);
  postprocess::write_vtk_links(folder / "links.vtp", pair.links(), pair.particles(), pair.time());
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName((folder / "links.vtp").c_str());
  reader->Update();
  REQUIRE(reader->GetOutput()->GetCellData()->GetArray("stretch") != nullptr);
  CHECK(reader->GetOutput()->GetCellData()->GetArray("stretch")->GetTuple1(0) > 0);

  dem::add_link_law(std::make_shared<dem::LinkLawKindOf<RubberLaw>>());
  const dem::LinkLawKind *found = dem::find_link_law("Rubber");
  REQUIRE(found != nullptr);
  struct Fill : dem::ConstantVisitor
  {
    void number(const char *key, double &member, const char *, const char *, double, double, bool) override
    {
      if (std::string(key) == "Modulus")
        member = E;
      if (std::string(key) == "Stiffening")
        member = b;
    }
    void choice(const char *,
                const std::vector<std::string> &,
                std::size_t,
                std::function<void(std::size_t)>,
                const char *) override
    {
    }
  } fill;
  const auto constants = found->constants();
  constants->visit(fill);
  const dem::LinkHistory history = dem::drive(*found, *constants, {{0.01, 0.02, -0.01}, {{0, 0}, {0, 0}, {0, 0}}});
  const auto             column  = [&](const std::string &name) {
    for (const auto &c : history.columns)
      if (c.name == name)
        return c.values;
    FAIL("no column " << name);
    return std::vector<double>();
  };
  CHECK(column("normal_stress")[1] == Approx(stress(0.02)).epsilon(1e-13));
  CHECK(column("stretch") == std::vector<double>{0.01, 0.02, 0.02});
}
