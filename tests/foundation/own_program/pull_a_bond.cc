// Two spheres and the bond between them, pulled apart: the force must be that of an elastic bar.
#include <dem/laws/elastic_links.h>
#include <dem/specimen/specimen.h>

#include <cmath>
#include <cstdio>

int main()
{
  constexpr double r = 5e-3, modulus = 30e9, speed = 1e-3;

  dem::Packing packing;
  packing.centre = {{0, 0, 0}, {2 * r, 0, 0}};
  packing.radius = {r, r};
  dem::SpecimenParameters parameters;
  parameters.density           = 2500;
  parameters.interaction_ratio = 1.1;
  dem::Specimen pair(packing, parameters, dem::elastic_links(modulus, 0.2));

  for (const std::size_t particle : {0, 1})
    {
      dem::Grip grip;
      grip.particles  = {particle};
      grip.prescribed = {true, true, true, true, true, true};
      grip.velocity   = {particle == 0 ? 0.0 : speed, 0, 0};
      pair.grips().add(grip);
    }
  pair.advance(1000);

  const double elongation = speed * (pair.time() - pair.time_step()); // forces are those of the last step's beginning
  const double expected   = modulus * M_PI * r * r * elongation / (2 * r);
  const double found      = pair.grips().reaction(1).x();
  std::printf("force %.9g N, bar %.9g N\n", found, expected);
  return std::fabs(found / expected - 1) < 1e-9 ? 0 : 1;
}
