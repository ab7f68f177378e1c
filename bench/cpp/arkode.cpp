// SUNDIALS ARKODE, ERKStep: embedded pairs. Samples come from its interpolant of degree 5, or ("-landing") from steps
// that end on them.
#include "harness.hpp"
#include "vectors.hpp"

#include <arkode/arkode_erkstep.h>

static int rates(realtype, N_Vector y, N_Vector f, void* ring) {
    static_cast<Ring*>(ring)->rates(N_VGetArrayPointer(y), N_VGetArrayPointer(f));
    return 0;
}

static ARKODE_ERKTableID table(const std::string& name) {
    if (name == "dormand-prince54") return ARKODE_DORMAND_PRINCE_7_4_5;
    if (name == "verner65") return ARKODE_VERNER_8_5_6;
    if (name == "fehlberg87") return ARKODE_FEHLBERG_13_7_8;
    throw std::runtime_error("methods: dormand-prince54, verner65, fehlberg87, each with -landing or without");
}

static long integrate(const Job& job, Ring& ring, Samples& samples) {
    const std::string suffix = "-landing";
    const std::size_t at = job.method.find(suffix);
    const bool landing = at != std::string::npos;
    SUNContext context;
    check(SUNContext_Create(nullptr, &context) == 0, "no context");
    std::vector<double> state = ring.start();
    N_Vector y = vectors::make(state.size(), state.data(), context);
    void* memory = ERKStepCreate(rates, 0.0, y, context);
    ERKStepSStolerances(memory, job.relative, job.absolute);
    ERKStepSetUserData(memory, &ring);
    ERKStepSetTableNum(memory, table(job.method.substr(0, at)));
    ERKStepSetMaxNumSteps(memory, 100000000);
    if (!landing) ERKStepSetInterpolantDegree(memory, 5);
    samples.take(0, state.data());
    double t = 0.0;
    for (int k = 1; k <= ring.scene.end; ++k) {
        if (landing || k == ring.scene.end) ERKStepSetStopTime(memory, k);
        check(ERKStepEvolve(memory, k, y, &t, ARK_NORMAL) >= 0, "ERKStepEvolve failed");
        samples.take(k, state.data());
    }
    long steps = 0;
    ERKStepGetNumSteps(memory, &steps);
    ERKStepFree(&memory);
    N_VDestroy(y);
    SUNContext_Free(&context);
    return steps;
}

int main(int count, char** argument) { return harness(count, argument, integrate); }
