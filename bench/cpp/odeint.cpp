// Boost.Odeint: steppers with an interpolant, and Fehlberg's pair of order 8(7), which lands on the samples.
#include "harness.hpp"

#include <boost/numeric/odeint.hpp>

namespace odeint = boost::numeric::odeint;
using State = std::vector<double>;

template <class Stepper>
static long run(Stepper stepper, Ring& ring, Samples& samples) {
    State y = ring.start();
    auto system = [&ring](const State& y, State& f, double) { ring.rates(y.data(), f.data()); };
    auto observe = [&samples](const State& y, double t) { samples.take(int(std::lround(t)), y.data()); };
    // integer multiples of 1.0 are exact, so the last one is the end itself
    odeint::integrate_n_steps(stepper, system, y, 0.0, 1.0, ring.scene.end, observe);
    return -1;  // the library does not count its steps
}

static long integrate(const Job& job, Ring& ring, Samples& samples) {
    const double absolute = job.absolute, relative = job.relative;
    if (job.method == "dopri54")
        return run(odeint::make_dense_output(absolute, relative, odeint::runge_kutta_dopri5<State>()), ring, samples);
    if (job.method == "fehlberg87")
        return run(odeint::make_controlled(absolute, relative, odeint::runge_kutta_fehlberg78<State>()), ring, samples);
    if (job.method == "bulirsch-stoer")
        return run(odeint::bulirsch_stoer<State>(absolute, relative, 1.0, 1.0), ring, samples);
    if (job.method == "bulirsch-stoer-dense")
        return run(odeint::bulirsch_stoer_dense_out<State>(absolute, relative, 1.0, 1.0), ring, samples);
    throw std::runtime_error("methods: dopri54, fehlberg87, bulirsch-stoer, bulirsch-stoer-dense");
}

int main(int count, char** argument) { return harness(count, argument, integrate); }
