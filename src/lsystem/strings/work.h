// The work of a derivation or a drawing, counted in units of about a nanosecond: modules read and written,
// steps of contexts, operations of expressions, questions to volumes, what the turtle draws.
#pragma once
#include <cstddef>
#include <string>

#include <espalier/lsystem/strings/limits.h>

namespace espalier::lsystem {

/// What each thing takes.
namespace work_of {
inline constexpr double kModule = 6, kValue = 2;   // read or written
inline constexpr double kCandidate = 10;           // a module that a rule is tried on
inline constexpr double kContextStep = 5;          // a module that a context looks at
inline constexpr double kOperation = 3;            // of an expression, on one module
inline constexpr double kBlock = 200;              // a rule or an operation, on a block of modules
inline constexpr double kVolume = 30;              // a point and a simple volume
inline constexpr double kInScene = 1500;           // a knot or a leaf that may stop light
inline constexpr double kRay = 400;                // of light
inline constexpr double kLuaCall = 300;            // of a body of a production
inline constexpr double kSymbol = 100;             // of the alphabet, before a string is read
inline constexpr double kKnot = 400, kLeaf = 400;  // drawn, and seen in a picture
inline constexpr double kCorner = 4;               // of a polygon that an ear is tried against
inline constexpr double kFrameStep = 60;           // from node to node of a frame of axes
}  // namespace work_of

class Work {
 public:
  explicit Work(std::string label, double limit = Limits{}.work) : label_(std::move(label)), limit_(limit) {}

  /// Throws TooMuchWork where the limit is passed.
  void add(double units) {
    done_ += units;
    if (done_ > limit_) fail();
  }
  void restart() { done_ = 0; }
  void set_limit(double limit) { limit_ = limit; }
  double done() const { return done_; }
  double left() const { return limit_ - done_; }

 private:
  [[noreturn]] void fail() const;

  std::string label_;  ///< what messages call the L-system
  double limit_ = 0, done_ = 0;
};

}  // namespace espalier::lsystem
