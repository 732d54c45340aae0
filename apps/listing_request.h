// Thrown while the command line is parsed, to end that.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <utility>

namespace hooke::app {

/// A text that the command line asks for instead of a run.
class ListingRequest : public CLI::Success {
 public:
  explicit ListingRequest(std::string listing) : listing_(std::move(listing)) {}
  const std::string& listing() const { return listing_; }

 private:
  std::string listing_;
};

}  // namespace hooke::app
