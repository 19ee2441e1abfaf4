// Tests of learned models compute with one thread: their tensors are tiny, and threads that wait for each other take a
// hundred times as long where other programs run.
#include <gtest/gtest.h>

#include "synth/learned/training/trainer.h"

namespace chironomia {
namespace {

class OneThread : public ::testing::Environment {
    void SetUp() override { use_threads(1); }
};

[[maybe_unused]] const auto* const kOneThread = ::testing::AddGlobalTestEnvironment(new OneThread);

}  // namespace
}  // namespace chironomia
