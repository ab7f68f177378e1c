// GSL: it has no interpolant, so every method lands on the samples. Its implicit methods (bsimp, msbdf) factor a dense
// Jacobian of 266 x 266 and are left out: nothing here is stiff.
#include "harness.hpp"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

static int rates(double, const double y[], double f[], void* ring) {
    static_cast<Ring*>(ring)->rates(y, f);
    return GSL_SUCCESS;
}

static const gsl_odeiv2_step_type* type(const std::string& name) {
    if (name == "rk8pd") return gsl_odeiv2_step_rk8pd;
    if (name == "rkf45") return gsl_odeiv2_step_rkf45;
    if (name == "msadams") return gsl_odeiv2_step_msadams;
    throw std::runtime_error("methods: rk8pd, rkf45, msadams");
}

static long integrate(const Job& job, Ring& ring, Samples& samples) {
    gsl_set_error_handler_off();
    std::vector<double> y = ring.start();
    gsl_odeiv2_system system{rates, nullptr, y.size(), &ring};
    gsl_odeiv2_driver* driver =
        gsl_odeiv2_driver_alloc_y_new(&system, type(job.method), 1e-3, job.absolute, job.relative);
    check(driver, "no driver");
    samples.take(0, y.data());
    double t = 0.0;
    for (int k = 1; k <= ring.scene.end; ++k) {
        check(gsl_odeiv2_driver_apply(driver, &t, k, y.data()) == GSL_SUCCESS, "gsl_odeiv2_driver_apply failed");
        samples.take(k, y.data());
    }
    const long steps = driver->e->count;
    gsl_odeiv2_driver_free(driver);
    return steps;
}

int main(int count, char** argument) { return harness(count, argument, integrate); }
