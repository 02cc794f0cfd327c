#pragma once

#include "postprocess/files/series.h"

#include <Eigen/Core>

#include <pybind11/numpy.h>

#include <cstddef>
#include <vector>

namespace python
{
  template <typename Value>
  pybind11::array_t<Value> array_of(const std::vector<Value> &values)
  {
    return pybind11::array_t<Value>(static_cast<pybind11::ssize_t>(values.size()), values.data());
  }

  /** (count, 3), of the vectors that a function gives to the numbers from 0. */
  template <typename VectorOf>
  pybind11::array_t<double> array_of_vectors(const std::size_t count, const VectorOf &vector_of)
  {
    pybind11::array_t<double> array({static_cast<pybind11::ssize_t>(count), pybind11::ssize_t{3}});
    auto                      numbers = array.mutable_unchecked<2>();
    for (std::size_t i = 0; i < count; ++i)
      {
        const Eigen::Vector3d vector = vector_of(i);
        for (int d = 0; d < 3; ++d)
          numbers(static_cast<pybind11::ssize_t>(i), d) = vector[d];
      }
    return array;
  }

  /** A row of numbers by the names of its columns: (name, unit, value). */
  inline pybind11::list named_numbers(const std::vector<postprocess::SeriesColumn> &columns,
                                      const std::vector<double>                    &row)
  {
    pybind11::list found;
    std::size_t    c = 0;
    for (const postprocess::SeriesColumn &column : columns)
      found.append(pybind11::make_tuple(column.name, column.unit, row.at(c++)));
    return found;
  }

  inline pybind11::array_t<double> array_of(const std::vector<Eigen::Vector3d> &values)
  {
    return array_of_vectors(values.size(), [&](const std::size_t i) { return values[i]; });
  }
} // namespace python
