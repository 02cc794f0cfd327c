#include "dem/observation/state_columns.h"

#include "base/voigt.h"
#include "dem/specimen/told_to_first.h"

#include <array>
#include <cstdint>

namespace dem
{
  namespace
  {
    constexpr StateColumn columns_of_links[] = {StateColumn::ends, StateColumn::direction, StateColumn::strength_damage,
                                                StateColumn::contact};

    void put(std::vector<double> &numbers, const Eigen::Vector3d &vector)
    {
      numbers.insert(numbers.end(), vector.data(), vector.data() + 3);
    }

    std::vector<double> flat(const std::vector<Eigen::Vector3d> &vectors)
    {
      std::vector<double> numbers;
      numbers.reserve(3 * vectors.size());
      for (const Eigen::Vector3d &vector : vectors)
        put(numbers, vector);
      return numbers;
    }

    std::vector<double> flat(const std::vector<std::int32_t> &whole) { return {whole.begin(), whole.end()}; }

    std::vector<double> flat(const std::vector<Eigen::Matrix3d> &tensors)
    {
      std::vector<double> numbers;
      numbers.reserve(6 * tensors.size());
      for (const Eigen::Matrix3d &tensor : tensors)
        {
          const base::Voigt six = base::stress_voigt(tensor);
          numbers.insert(numbers.end(), six.data(), six.data() + six.size());
        }
      return numbers;
    }

    void put(std::vector<double>              &numbers,
             const StateColumn                 column,
             const std::array<std::size_t, 2> &ends,
             const LinkDamage                 &link,
             const Eigen::Vector3d            &contact)
    {
      if (column == StateColumn::ends)
        numbers.insert(numbers.end(), {static_cast<double>(ends[0]), static_cast<double>(ends[1])});
      else if (column == StateColumn::strength_damage)
        numbers.push_back(link.damage);
      else
        put(numbers, column == StateColumn::direction ? link.direction : contact);
    }
  } // namespace

  void each_column(const DiscreteState &state, const UseOfStateColumn &use)
  {
    use(StateColumn::reference, flat(state.reference));
    use(StateColumn::position, flat(state.position));
    use(StateColumn::radius, state.radius);
    use(StateColumn::volume, state.volume);
    use(StateColumn::stress, flat(state.stress));
    use(StateColumn::held, flat(state.held));
    for (const StateColumn column : columns_of_links)
      {
        std::vector<double> numbers;
        for (std::size_t l = 0; l < state.damage.ends.size(); ++l)
          put(numbers, column, state.damage.ends[l], state.damage.links[l], state.damage.contact[l]);
        use(column, numbers);
      }
  }

  namespace
  {
    void each_column_of_particles(const ObservedSpecimen &specimen, const UseOfStateColumn &use)
    {
      ParticleOutput particles = placed_particles_for_first(specimen);
      for (std::size_t i = 0; i < particles.position.size(); ++i) // what it has moved by becomes where it was
        particles.displacement[i] = particles.position[i] - particles.displacement[i];
      use(StateColumn::reference, flat(particles.displacement));
      use(StateColumn::position, flat(particles.position));
      use(StateColumn::radius, particles.radius);
      use(StateColumn::volume, particles.volume);
      use(StateColumn::stress, stress_for_first(specimen));
      use(StateColumn::held, flat(particles.held));
    }
  } // namespace

  void each_column(const ObservedSpecimen &specimen, const UseOfStateColumn &use)
  {
    each_column_of_particles(specimen, use);
    std::size_t links = 0;
    for (const StateColumn column : columns_of_links)
      {
        std::vector<double> numbers;
        numbers.reserve(numbers_of_row(column) * links);
        tell_first_of_links(
          specimen,
          [column](const LinkOutput &some, const std::size_t l, std::vector<double> &told) {
            if (some.kind[l] != LinkOutput::contact)
              put(told, column, some.ends[l], damage_of(some, l), some.load[l].contact);
          },
          [&](const std::vector<double> &told) { numbers.insert(numbers.end(), told.begin(), told.end()); });
        links = numbers.size() / numbers_of_row(column);
        use(column, numbers);
      }
  }
} // namespace dem
