#include "dem/emission/emission.h"

#include "base/errors.h"
#include "dem/emission/moment_tensor.h"
#include "dem/measures/link_measures.h"

#include <algorithm>
#include <limits>

namespace dem
{
  namespace
  {
    bool is_in(const std::vector<std::int32_t> &body, const std::int32_t particle)
    {
      return std::binary_search(body.begin(), body.end(), particle);
    }

    /** doc/theory/acoustic-emission.md, (2): add f (x) (c - origin) of the forces that a set's links exert on a particle of a body, but for those within it [N m]. */
    void add_moment_around(const std::vector<std::int32_t> &body,
                           const std::int32_t               particle,
                           const Eigen::Vector3d           &origin,
                           const Particles                 &particles,
                           const LinkSet                   &links,
                           Eigen::Matrix3d                 &sum)
    {
      const auto add = [&](const std::size_t l, const std::int32_t other, const double sign) {
        if (!links.is_alive(l) || is_in(body, other))
          return;
        const LinkView        seen = link_at(particles, links, l, Geometry::present);
        const std::int32_t    J = links.first[l], K = links.second[l];
        const double          arm     = 0.5 * (seen.length + particles.radius_of(J) - particles.radius_of(K));
        const Eigen::Vector3d contact = particles.position_of(J) + arm * seen.direction;
        sum += sign * seen.force * (contact - origin).transpose();
      };
      const auto i = static_cast<std::size_t>(particle);
      for (std::int32_t o = links.own_begin[i]; o < links.own_begin[i + 1]; ++o)
        add(links.own(o), links.second[links.own(o)], 1);
      for (std::int32_t o = links.other_begin[i]; o < links.other_begin[i + 1]; ++o)
        {
          const auto l = static_cast<std::size_t>(links.others[o]);
          add(l, links.first[l], -1);
        }
    }

    Eigen::Matrix3d moment_around(const std::vector<std::int32_t> &body,
                                  const Eigen::Vector3d           &origin,
                                  const Particles                 &particles,
                                  const LinkSet                   &bonds,
                                  const LinkSet                   &contacts)
    {
      Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
      for (const std::int32_t particle : body)
        for (const LinkSet *links : {&bonds, &contacts})
          if (links->alive > 0)
            add_moment_around(body, particle, origin, particles, *links, sum);
      return sum;
    }

    void enter(EmissionEvent &event, const Break &b)
    {
      event.place = (event.area * event.place + b.area * b.place) / (event.area + b.area);
      event.area += b.area;
      event.lasts = b.time - event.time;
      ++(b.mode == BreakMode::tension ? event.in_tension : b.mode == BreakMode::shear ? event.in_shear : event.gradual);
    }
  } // namespace

  EmissionWindow emission_window(const double     reach_in_diameters,
                                 const int        dimension,
                                 const Particles &particles,
                                 const LinkSet   &bonds,
                                 const LinkLaw   &law)
  {
    if (bonds.alive == 0)
      throw base::InputError("Emission/Reach: nothing can be heard where no bonds are that could break.");
    double     stiff = 0, mass = 0, diameters = 0;
    LinkReader reader(particles, bonds, law);
    for (std::size_t l = 0; l < bonds.count; ++l)
      if (bonds.is_alive(l))
        {
          reader.read(l, Geometry::present);
          const LinkStiffnesses modulus = reader.closed_stiffness();
          const double size = reader.view().length * reader.view().length * bonds.area[l] / bonds.reference_length[l];
          stiff += size * (dimension == 3 ? (2 * modulus.normal + 3 * modulus.shear) / 30 :
                                            (modulus.normal + modulus.shear) / 8);
        }
    for (std::size_t i = 0; i < particles.count; ++i)
      {
        mass += particles.mass[i];
        diameters += 2 * particles.radius_of(i);
      }
    EmissionWindow window;
    window.reach = reach_in_diameters * diameters / static_cast<double>(particles.count);
    window.lasts = 2 * window.reach / (0.5 * std::sqrt(stiff / mass));
    return window;
  }

  std::vector<Emission::Source>::iterator Emission::source_near(const Break &b)
  {
    auto   nearest = sources.end();
    double least   = std::numeric_limits<double>::infinity();
    for (auto source = sources.begin(); source != sources.end(); ++source)
      for (const Eigen::Vector3d &place : source->places)
        if (const double distance = (place - b.place).norm(); distance <= window.reach && distance < least)
          {
            least   = distance;
            nearest = source;
          }
    return nearest;
  }

  void Emission::take_up(
    const Break &b, const double time, const Particles &particles, const LinkSet &bonds, const LinkSet &contacts)
  {
    auto            source = source_near(b);
    Eigen::Matrix3d tensor = Eigen::Matrix3d::Zero();
    if (source == sources.end())
      {
        heard.emplace_back();
        heard.back().time = b.time;
        source            = sources.emplace(sources.end());
        source->event     = heard.size() - 1;
        source->origin    = b.place;
      }
    else
      tensor = source->at_start - moment_around(source->body, source->origin, particles, bonds, contacts);
    for (const std::int32_t end : b.ends)
      if (end >= 0 && !is_in(source->body, end))
        source->body.insert(std::lower_bound(source->body.begin(), source->body.end(), end), end);
    source->places.push_back(b.place);
    source->ends     = time + window.lasts;
    source->at_start = tensor + moment_around(source->body, source->origin, particles, bonds, contacts);
    enter(heard[source->event], b);
  }

  void Emission::listen(
    const Particles &particles, const LinkSet &bonds, const LinkSet &contacts, const BreakLog &log, const double time)
  {
    sources.erase(std::remove_if(sources.begin(), sources.end(), [&](const Source &s) { return time > s.ends; }),
                  sources.end());
    for (; logged < log.size(); ++logged)
      take_up(log.at(logged), time, particles, bonds, contacts);
    for (const Source &source : sources)
      follow(source, moment_around(source.body, source.origin, particles, bonds, contacts));
  }

  /** What the body does to its surroundings is the opposite of what they do to it. */
  void Emission::follow(const Source &source, const Eigen::Matrix3d &around)
  {
    const Eigen::Matrix3d change = source.at_start - around, tensor = 0.5 * (change + change.transpose());
    Eigen::Matrix3d      &largest = heard[source.event].moment;
    if (scalar_moment(tensor) > scalar_moment(largest))
      largest = tensor;
  }
} // namespace dem
