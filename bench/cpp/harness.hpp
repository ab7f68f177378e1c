// What a program does around its integrator: arguments, samples, the clock of the process, results.
//
//   PROGRAM CASE FORM METHOD TOLERANCE RATIO REPEATS TIMES STATES
//
// RATIO: absolute over relative tolerance. TIMES: "1,10,50", where the state is kept for STATES (CSV t,n,gap,speed).
// Prints one line of JSON: CPU seconds of each repeat's integration, right-hand sides, steps of the last one.
#pragma once

#include "ring.hpp"

#include <cstdio>
#include <ctime>
#include <functional>
#include <set>
#include <sstream>

struct Job {
    std::string method;
    double relative, absolute;
};

// Receives the state at t = 0, 1, 2, ...: the speeds' standard deviation always, the state where it is wanted.
class Samples {
public:
    Samples(const Ring& ring, const std::set<int>& wanted) : ring(ring), wanted(wanted) {
        spread.reserve(ring.scene.end + 1);
        kept.reserve(wanted.size() * ring.dimension());
    }

    void take(int t, const double* y) {
        const double* v = y + ring.n;
        double mean = 0.0, square = 0.0;
        for (std::size_t i = 0; i < ring.n; ++i) mean += v[i];
        mean /= ring.n;
        for (std::size_t i = 0; i < ring.n; ++i) square += (v[i] - mean) * (v[i] - mean);
        spread.push_back(std::sqrt(square / ring.n));
        if (wanted.count(t)) kept.insert(kept.end(), y, y + ring.dimension());
    }

    void write(const char* path) const {
        std::FILE* file = std::fopen(path, "w");
        if (!file) throw std::runtime_error(std::string("cannot write ") + path);
        std::fprintf(file, "t,n,gap,speed\n");
        const double* y = kept.data();
        for (int t : wanted) {
            for (std::size_t i = 0; i < ring.n; ++i)
                std::fprintf(file, "%d,%zu,%.17g,%.17g\n", t, i, ring.gap(y, i), ring.speed(y, i));
            y += ring.dimension();
        }
        if (std::fclose(file)) throw std::runtime_error(std::string("cannot write ") + path);
    }

    std::vector<double> spread;

private:
    const Ring& ring;
    const std::set<int>& wanted;
    std::vector<double> kept;
};

inline double cpu_seconds() {
    timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return now.tv_sec + 1e-9 * now.tv_nsec;
}

// Integrates from 0 to the end, calls take(t, y) at 0, 1, 2, ..., gives the number of steps.
using Integrate = std::function<long(const Job&, Ring&, Samples&)>;

inline void check(bool good, const std::string& what) {
    if (!good) throw std::runtime_error(what);
}

inline int harness(int count, char** argument, const Integrate& integrate) try {
    check(count == 9, "usage: CASE FORM METHOD TOLERANCE RATIO REPEATS TIMES STATES");
    const Case scene = find_case(argument[1]);
    const double tolerance = std::stod(argument[4]);
    const Job job{argument[3], tolerance, tolerance * std::stod(argument[5])};
    std::set<int> wanted;
    std::stringstream times(argument[7]);
    for (std::string time; std::getline(times, time, ',');) wanted.insert(std::stoi(time));
    std::string seconds;
    long steps = 0, evaluations = 0;
    for (int repeat = std::stoi(argument[6]); repeat > 0; --repeat) {
        Ring ring(scene, argument[2] == std::string("deviation"));
        Samples samples(ring, wanted);
        const double start = cpu_seconds();
        steps = integrate(job, ring, samples);
        char text[32];
        std::snprintf(text, sizeof text, "%s%.9f", seconds.empty() ? "" : ", ", cpu_seconds() - start);
        seconds += text;
        evaluations = ring.evaluations;
        check(samples.spread.size() == std::size_t(scene.end) + 1, "not all samples were taken");
        if (repeat == 1) samples.write(argument[8]);
    }
    std::printf("{\"seconds\": [%s], \"evaluations\": %ld, \"steps\": %ld}\n", seconds.c_str(), evaluations, steps);
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
