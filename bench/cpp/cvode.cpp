// SUNDIALS CVODE: Adams methods of variable order, functional iteration without acceleration.
#include "harness.hpp"
#include "vectors.hpp"

#include <cvode/cvode.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

static int rates(realtype, N_Vector y, N_Vector f, void* ring) {
    static_cast<Ring*>(ring)->rates(N_VGetArrayPointer(y), N_VGetArrayPointer(f));
    return 0;
}

static long integrate(const Job& job, Ring& ring, Samples& samples) {
    check(job.method == "adams", "methods: adams");
    SUNContext context;
    check(SUNContext_Create(nullptr, &context) == 0, "no context");
    std::vector<double> state = ring.start();
    N_Vector y = vectors::make(state.size(), state.data(), context);
    void* memory = CVodeCreate(CV_ADAMS, context);
    CVodeInit(memory, rates, 0.0, y);
    CVodeSStolerances(memory, job.relative, job.absolute);
    CVodeSetUserData(memory, &ring);
    SUNNonlinearSolver solver = SUNNonlinSol_FixedPoint(y, 0, context);
    CVodeSetNonlinearSolver(memory, solver);
    CVodeSetMaxNumSteps(memory, 100000000);
    CVodeSetStopTime(memory, ring.scene.end);
    samples.take(0, state.data());
    double t = 0.0;
    for (int k = 1; k <= ring.scene.end; ++k) {
        check(CVode(memory, k, y, &t, CV_NORMAL) >= 0, "CVode failed");
        samples.take(k, state.data());
    }
    long steps = 0;
    CVodeGetNumSteps(memory, &steps);
    SUNNonlinSolFree(solver);
    CVodeFree(&memory);
    N_VDestroy(y);
    SUNContext_Free(&context);
    return steps;
}

int main(int count, char** argument) { return harness(count, argument, integrate); }
