// The right-hand side as a shared library, for integrators driven from Python: one ring at a time.
#include "ring.hpp"

#include <memory>

static std::unique_ptr<Ring> ring;

extern "C" {

// Chooses the ring and gives the dimension of its state.
long ring_open(const char* name, int deviation) {
    ring = std::make_unique<Ring>(find_case(name), deviation != 0);
    return long(ring->dimension());
}

void ring_start(double* y) {
    const std::vector<double> start = ring->start();
    std::copy(start.begin(), start.end(), y);
}

long ring_evaluations() { return ring->evaluations; }

void ring_rates(double, double* y, double* f, double*) { ring->rates(y, f); }
}
