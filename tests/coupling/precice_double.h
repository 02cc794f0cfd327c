#pragma once

#include "coupling/precice/interface.h"

#include <Eigen/Core>

#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace precice_double
{
  using Values = std::map<std::string, std::vector<double>>; ///< of all vertices, by the name of the data

  /** One window that stands: what was read in it, and what was written at its end. */
  struct Window
  {
    Values read, written;
  };

  /** Another code, and what its double of preCICE has seen. */
  struct Course
  {
    std::function<Values(const Values &written, double time)> answer; ///< what is read next
    Values                                                    readable;
    double                                                    window = 0, end = 0; ///< [s]

    int    iterations = 1; ///< of each window; above 1: implicit
    int    dimensions = 3;
    bool   initial    = false; ///< whether data are wanted before the start
    double time       = 0;

    std::vector<double> places;
    Values              first; ///< data of before the start
    std::vector<Window> windows;
    int                 advances  = 0;
    bool                finalized = false;
  };

  inline void demand(const bool kept, const char *rule)
  {
    if (!kept)
      throw std::logic_error(std::string("preCICE would refuse: ") + rule);
  }

  /** The interface of preCICE in this process, which throws at whatever preCICE forbids. */
  class Double : public coupling::PreciceInterface
  {
  public:
    explicit Double(Course &course)
      : c(course)
    {
    }

    int mesh_dimensions(const std::string &mesh) const override
    {
      demand(mesh == "Mesh", "there is one mesh");
      return c.dimensions;
    }

    std::vector<int> set_mesh_vertices(const std::string &, const std::vector<double> &positions) override
    {
      demand(state == State::fresh && positions.size() % static_cast<std::size_t>(c.dimensions) == 0, "vertices");
      c.places = positions;
      for (std::size_t k = 0; k < positions.size() / static_cast<std::size_t>(c.dimensions); ++k)
        ids.push_back(100 + static_cast<int>(k));
      return ids;
    }

    bool requires_initial_data() override
    {
      demand(state == State::fresh, "initial data come before the start");
      return c.initial;
    }

    void initialize() override
    {
      demand(state == State::fresh && !ids.empty() && written.empty() != c.initial, "the start");
      c.first = std::move(written);
      written.clear();
      state      = State::running;
      must_write = c.iterations > 1;
    }

    bool is_coupling_ongoing() const override
    {
      demand(state == State::running, "it has started");
      return c.time < c.end * (1 - 1e-9);
    }

    double max_time_step_size() const override { return c.window; }

    bool requires_writing_checkpoint() override { return std::exchange(must_write, false); }
    bool requires_reading_checkpoint() override { return std::exchange(must_read, false); }

    std::vector<double> read_data(const std::string      &mesh,
                                  const std::string      &data,
                                  const std::vector<int> &vertices,
                                  const double            relative_time) const override
    {
      demand(state == State::running && mesh == "Mesh" && vertices == ids, "reading");
      demand(relative_time >= 0 && relative_time <= c.window, "reading within the window");
      demand(!must_write && !must_read, "checkpoints come first");
      return c.readable.at(data);
    }

    void write_data(const std::string &,
                    const std::string         &data,
                    const std::vector<int>    &vertices,
                    const std::vector<double> &values) override
    {
      demand(vertices == ids && values.size() == c.places.size(), "writing");
      written[data] = values;
    }

    void advance(const double time_step) override
    {
      demand(state == State::running && is_coupling_ongoing() && time_step == c.window, "advancing");
      demand(!must_write && !must_read, "checkpoints come first");
      ++c.advances;
      Values used = std::move(c.readable);
      c.readable  = c.answer(written, c.time + c.window);
      must_read   = ++iteration < c.iterations;
      if (!must_read)
        {
          iteration = 0;
          c.time += c.window;
          c.windows.push_back({std::move(used), std::move(written)});
          must_write = c.iterations > 1 && is_coupling_ongoing();
        }
      written.clear();
    }

    void finalize() override
    {
      demand(state == State::running, "the end");
      state       = State::over;
      c.finalized = true;
    }

  private:
    enum class State
    {
      fresh,
      running,
      over
    };

    Course          &c;
    State            state = State::fresh;
    std::vector<int> ids;
    Values           written;
    int              iteration  = 0;
    bool             must_write = false, must_read = false;
  };

  /** Vector of a vertex. */
  inline Eigen::Vector3d at(const std::vector<double> &values, const std::size_t vertex)
  {
    return {values.at(3 * vertex), values.at(3 * vertex + 1), values.at(3 * vertex + 2)};
  }
} // namespace precice_double
