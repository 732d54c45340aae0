// Arithmetic on matrices of one column per vertex, by all threads.
#pragma once

#include "hooke/core/parallel.h"
#include "hooke/core/types.h"

namespace hooke {

/// Calls body(first, count) on blocks of columns.
template <typename Body>
void for_columns(Eigen::Index columns, const Body& body) {
  parallel_for(static_cast<std::size_t>(columns), 4096, [&](std::size_t begin, std::size_t end) {
    body(static_cast<Eigen::Index>(begin), static_cast<Eigen::Index>(end - begin));
  });
}

/// Sum of all products of their entries; of any precision, in double precision.
template <typename A, typename B>
double dot(const A& a, const B& b) {
  return parallel_sum(static_cast<std::size_t>(a.cols()), 4096, [&](std::size_t begin, std::size_t end) {
    const auto first = static_cast<Eigen::Index>(begin), count = static_cast<Eigen::Index>(end - begin);
    return a.middleCols(first, count)
        .template cast<double>()
        .cwiseProduct(b.middleCols(first, count).template cast<double>())
        .sum();
  });
}

/// dot(a, b - c)
inline double dot_with_difference(const Mat3X& a, const Mat3X& b, const Mat3X& c) {
  return parallel_sum(static_cast<std::size_t>(a.cols()), 4096, [&](std::size_t begin, std::size_t end) {
    const auto first = static_cast<Eigen::Index>(begin), count = static_cast<Eigen::Index>(end - begin);
    return a.middleCols(first, count)
        .cwiseProduct(b.middleCols(first, count) - c.middleCols(first, count))
        .sum();
  });
}

/// a += factor * b
template <typename B>
void add_scaled(double factor, const B& b, Mat3X& a) {
  for_columns(a.cols(), [&](Eigen::Index first, Eigen::Index count) {
    a.middleCols(first, count) += factor * b.middleCols(first, count).template cast<double>();
  });
}

/// a = factor * b
template <typename B, typename A>
void assign_scaled(double factor, const B& b, A& a) {
  a.resize(3, b.cols());
  for_columns(a.cols(), [&](Eigen::Index first, Eigen::Index count) {
    a.middleCols(first, count) = (factor * b.middleCols(first, count)).template cast<typename A::Scalar>();
  });
}

/// difference = a - b, which may be one of them
inline void subtract(const Mat3X& a, const Mat3X& b, Mat3X& difference) {
  difference.resize(3, a.cols());
  for_columns(a.cols(), [&](Eigen::Index first, Eigen::Index count) {
    difference.middleCols(first, count) = a.middleCols(first, count) - b.middleCols(first, count);
  });
}

}  // namespace hooke
