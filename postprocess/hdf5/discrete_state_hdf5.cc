#include "postprocess/hdf5/discrete_state_hdf5.h"

#include "base/errors.h"

#include <stdexcept>

namespace postprocess
{
  namespace
  {
    constexpr std::int64_t state_version = 1;
    constexpr const char  *state_format  = "breccia discrete state";
    constexpr int          voigt[6][2]   = {{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}};

    /** Rows of an array with the given number of columns. */
    std::size_t
    rows_of(const hdf5::InputFile &file, const std::string &name, const std::size_t columns, const std::string &origin)
    {
      const hdf5::Shape shape = file.shape(name);
      const bool        fits  = columns == 1 ? shape.size() == 1 : shape.size() == 2 && shape[1] == columns;
      if (!fits)
        throw base::InputError(origin + ": \"" + name + "\" must have " + std::to_string(columns) +
                               " number(s) a row; it has another shape.");
      return shape[0];
    }

    /** All numbers of an array, row by row. */
    template <typename Number>
    std::vector<Number>
    read(const hdf5::InputFile &file, const std::string &name, const std::size_t columns, const std::string &origin)
    {
      std::vector<Number> values(columns * rows_of(file, name, columns, origin));
      if (!values.empty())
        file.read(name, values.data());
      return values;
    }

    std::vector<Eigen::Vector3d>
    read_vectors(const hdf5::InputFile &file, const std::string &name, const std::string &origin)
    {
      const std::vector<double>    flat = read<double>(file, name, 3, origin);
      std::vector<Eigen::Vector3d> vectors(flat.size() / 3);
      for (std::size_t i = 0; i < vectors.size(); ++i)
        vectors[i] = Eigen::Vector3d(&flat[3 * i]);
      return vectors;
    }

    const char *name_of(const dem::StateColumn column)
    {
      switch (column)
        {
        case dem::StateColumn::reference:
          return "particles/reference";
        case dem::StateColumn::position:
          return "particles/position";
        case dem::StateColumn::radius:
          return "particles/radius";
        case dem::StateColumn::volume:
          return "particles/volume";
        case dem::StateColumn::stress:
          return "particles/stress";
        case dem::StateColumn::held:
          return "particles/held";
        case dem::StateColumn::ends:
          return "links/ends";
        case dem::StateColumn::direction:
          return "links/direction";
        case dem::StateColumn::strength_damage:
          return "links/strength_damage";
        case dem::StateColumn::contact:
          return "links/contact";
        }
      throw std::logic_error("no column of a discrete state");
    }

    template <typename Number>
    void write_whole_numbers(hdf5::OutputFile          &file,
                             const char                *name,
                             const std::vector<double> &numbers,
                             const hdf5::Shape         &shape)
    {
      const std::vector<Number> whole(numbers.begin(), numbers.end());
      file.write(name, whole.data(), shape);
    }

    void read_particles(const hdf5::InputFile &file, const std::string &origin, dem::DiscreteState &state)
    {
      state.reference                  = read_vectors(file, "particles/reference", origin);
      state.position                   = read_vectors(file, "particles/position", origin);
      state.radius                     = read<double>(file, "particles/radius", 1, origin);
      state.volume                     = read<double>(file, "particles/volume", 1, origin);
      state.held                       = read<std::int32_t>(file, "particles/held", 1, origin);
      const std::vector<double> stress = read<double>(file, "particles/stress", 6, origin);
      state.stress.resize(stress.size() / 6);
      for (std::size_t p = 0; p < state.stress.size(); ++p)
        for (int c = 0; c < 6; ++c)
          {
            const auto &[i, j]    = voigt[c];
            state.stress[p](i, j) = state.stress[p](j, i) = stress[6 * p + static_cast<std::size_t>(c)];
          }
    }

    void read_links(const hdf5::InputFile &file, const std::string &origin, dem::CohesiveDamage &damage)
    {
      const std::vector<std::int64_t>    ends      = read<std::int64_t>(file, "links/ends", 2, origin);
      const std::vector<Eigen::Vector3d> direction = read_vectors(file, "links/direction", origin);
      const std::vector<double>          lost      = read<double>(file, "links/strength_damage", 1, origin);
      damage.contact                               = read_vectors(file, "links/contact", origin);
      if (lost.size() != direction.size() || damage.contact.size() != direction.size())
        throw base::InputError(origin + ": the arrays of \"links\" differ in length.");
      for (std::size_t l = 0; l + 1 < ends.size(); l += 2)
        damage.ends.push_back({static_cast<std::size_t>(ends[l]), static_cast<std::size_t>(ends[l + 1])});
      for (std::size_t l = 0; l < direction.size(); ++l)
        damage.links.push_back({direction[l], lost[l]});
    }
  } // namespace

  DiscreteStateFile::DiscreteStateFile(const std::filesystem::path &path, const int dimension, const double time)
    : file(path)
  {
    const std::int64_t in_space = dimension;
    file.write_text("format", state_format);
    file.write("format_version", &state_version, {});
    file.write_text("units", "m, s, Pa");
    file.write("dimension", &in_space, {});
    file.write("time", &time, {});
  }

  void DiscreteStateFile::write(const dem::StateColumn column, const std::vector<double> &numbers)
  {
    const std::size_t of_row = dem::numbers_of_row(column);
    hdf5::Shape       shape  = {numbers.size() / of_row};
    if (of_row > 1)
      shape.push_back(of_row);
    if (column == dem::StateColumn::held)
      write_whole_numbers<std::int32_t>(file, name_of(column), numbers, shape);
    else if (column == dem::StateColumn::ends)
      write_whole_numbers<std::int64_t>(file, name_of(column), numbers, shape);
    else
      file.write(name_of(column), numbers.data(), shape);
  }

  void write_discrete_state(const dem::DiscreteState &state, const std::filesystem::path &path)
  {
    DiscreteStateFile file(path, state.dimension, state.time);
    dem::each_column(
      state, [&](const dem::StateColumn column, const std::vector<double> &numbers) { file.write(column, numbers); });
    file.commit();
  }

  dem::DiscreteState read_discrete_state(const std::filesystem::path &path)
  {
    const hdf5::InputFile file(path);
    const std::string     origin = path.string();
    if (!file.has("format") || file.read_text("format") != state_format)
      throw base::InputError(origin + ": is not a discrete state (its \"format\" must be \"" + state_format + "\").");
    std::int64_t version = 0, dimension = 0;
    file.read("format_version", &version);
    if (version != state_version)
      throw base::InputError(origin + ": discrete state of format " + std::to_string(version) +
                             ", this program reads format " + std::to_string(state_version) + ".");
    dem::DiscreteState state;
    file.read("dimension", &dimension);
    state.dimension = static_cast<int>(dimension);
    file.read("time", &state.time);
    read_particles(file, origin, state);
    read_links(file, origin, state.damage);
    dem::check_discrete_state(state, origin);
    return state;
  }
} // namespace postprocess
