// Pedestrians on a ring, for integrators written in C or C++: the same right-hand side and the same samples for each.
//
// State: gaps, then speeds ("plain"), or their deviations from the uniform flow, then that flow's speed ("deviation").
// No law here has a neighbour's speed in its acceleration, so both loops run over whole arrays and vectorise.
#pragma once

#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

// A scene: the ring, the start and the law.
struct Case {
    std::string name;
    std::size_t pedestrians;
    double length, shift, v0, mu, epsilon;
    int end;
    bool logarithmic;
};

inline Case find_case(const std::string& name) {
    if (name == "algebraic_stable") return {name, 67, 200.0, 1e-4, 3.0, 0.45, 0.1, 500, false};
    if (name == "logarithmic") return {name, 133, 200.0, 0.1, 1.0, 0.0, 0.01, 3000, true};
    if (name == "logarithmic_small_shift") return {name, 133, 200.0, 1e-4, 1.0, 0.0, 0.01, 3000, true};
    throw std::runtime_error("no case " + name);
}

class Ring {
public:
    Ring(const Case& scene, bool deviation)
        : scene(scene), deviation(deviation), n(scene.pedestrians), headway(scene.length / n) {}

    std::size_t dimension() const { return 2 * n + (deviation ? 1 : 0); }

    std::vector<double> start() const {
        std::vector<double> y(dimension(), 0.0);
        if (!deviation)
            for (std::size_t i = 0; i < n; ++i) y[i] = headway;
        y[0] -= scene.shift;
        y[n - 1] += scene.shift;
        return y;
    }

    void rates(const double* __restrict y, double* __restrict f) {
        ++evaluations;
        const double* v = y + n;
        for (std::size_t i = 0; i + 1 < n; ++i) f[i] = v[i + 1] - v[i];
        f[n - 1] = v[0] - v[n - 1];
        if (deviation) {
            scene.logarithmic ? logarithmic_deviation(y, f) : algebraic_deviation(y, f);
            f[2 * n] = uniform_acceleration() - y[2 * n];
        } else {
            scene.logarithmic ? logarithmic(y, f) : algebraic(y, f);
        }
    }

    double gap(const double* y, std::size_t i) const { return deviation ? headway + y[i] : y[i]; }
    double speed(const double* y, std::size_t i) const { return deviation ? y[2 * n] + y[n + i] : y[n + i]; }

    const Case scene;
    const bool deviation;
    const std::size_t n;
    const double headway;
    long evaluations = 0;

private:
    static constexpr double C = 1.718281828459045;

    // eq:invd with delta = 0, a_v = 0, q = 2
    void algebraic(const double* __restrict y, double* __restrict f) const {
        const double v0 = scene.v0, square = scene.mu * scene.mu;
        for (std::size_t i = 0; i < n; ++i) {
            const double d = y[i] - 2.0;
            f[n + i] = v0 - y[n + i] - square / (d * d);
        }
    }

    // mu^2 / D^2 - mu^2 / (D + u)^2 without the difference of two nearly equal numbers
    void algebraic_deviation(const double* __restrict y, double* __restrict f) const {
        const double D = headway - 2.0, scale = scene.mu * scene.mu / (D * D);
        for (std::size_t i = 0; i < n; ++i) {
            const double d = D + y[i];
            f[n + i] = scale * (y[i] * (2.0 * D + y[i])) / (d * d) - y[n + i];
        }
    }

    // eq:modlog with a_v = 0; ln(1 + .) is exact enough here, since only absolute errors count
    void logarithmic(const double* __restrict y, double* __restrict f) const {
        const double v0 = scene.v0, slope = -1.0 / scene.epsilon, c = C * scene.epsilon;
        for (std::size_t i = 0; i < n; ++i) {
            const double softplus = std::log(1.0 + std::exp((0.5 * y[i] - 1.0) * slope));
            f[n + i] = v0 * (1.0 - std::log(1.0 + c * softplus)) - y[n + i];
        }
    }

    // softplus(z + x) - softplus(z) = x + ln(1 + q (e^-x - 1)), q = 1 / (1 + e^z): small in this uniform flow
    void logarithmic_deviation(const double* __restrict y, double* __restrict f) const {
        const double slope = -0.5 / scene.epsilon, z = (0.5 * headway - 1.0) / -scene.epsilon;
        const double q = 1.0 / (1.0 + std::exp(z)), softplus = z + std::log1p(std::exp(-z));
        const double v0 = scene.v0, scale = C * scene.epsilon / (1.0 + C * scene.epsilon * softplus);
        for (std::size_t i = 0; i < n; ++i) {
            const double x = y[i] * slope;
            const double difference = x + std::log1p(q * (std::exp(-x) - 1.0));
            f[n + i] = -v0 * std::log1p(scale * difference) - y[n + i];
        }
    }

    double uniform_acceleration() const {
        const double D = headway - 2.0;
        if (!scene.logarithmic) return scene.v0 - scene.mu * scene.mu / (D * D);
        const double softplus = std::log1p(std::exp((0.5 * headway - 1.0) / -scene.epsilon));
        return scene.v0 * (1.0 - std::log1p(C * scene.epsilon * softplus));
    }
};
