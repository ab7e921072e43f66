// SPDX-License-Identifier: BSD-3-Clause
#include "scene_textures.h"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

namespace chain_tracker {

cv::Mat3b paintNoise(const cv::Size& size, const cv::Scalar& mean, double contrast, cv::RNG& rng) {
  cv::Mat3f sum(size, cv::Vec3f(static_cast<float>(mean[0]), static_cast<float>(mean[1]),
                                static_cast<float>(mean[2])));
  for (int octave = 0; octave < 4; ++octave) {
    const int cells = 4 << octave;
    cv::Mat3f coarse(std::max(2, cells * size.height / std::max(size.width, 1)), cells);
    rng.fill(coarse, cv::RNG::NORMAL, 0.0, contrast / (octave + 1.0));
    cv::Mat3f fine;
    cv::resize(coarse, fine, size, 0.0, 0.0, cv::INTER_CUBIC);
    sum += fine;
  }
  cv::Mat3b image;
  sum.convertTo(image, CV_8UC3);
  return image;
}

cv::Mat3b paintMottle(const cv::Size& size, const cv::Scalar& mean, double contrast, cv::RNG& rng) {
  // A quarter of the noise keeps its colour, the rest becomes light and shade.
  const cv::Scalar middle = cv::Scalar::all(128.0);
  const cv::Mat3b noise = paintNoise(size, middle, 1.7 * contrast, rng);
  cv::Mat1b grey;
  cv::cvtColor(noise, grey, cv::COLOR_BGR2GRAY);
  cv::Mat3b shade;
  cv::cvtColor(grey, shade, cv::COLOR_GRAY2BGR);
  cv::Mat3f sum;
  cv::Mat3f shade_offset;
  noise.convertTo(sum, CV_32FC3, 0.2, -0.2 * 128.0);
  shade.convertTo(shade_offset, CV_32FC3, 1.0, -128.0);
  sum += shade_offset;
  sum += mean;
  cv::Mat3b image;
  sum.convertTo(image, CV_8UC3);
  return image;
}

void addGrain(double contrast, double softness, cv::RNG& rng, cv::Mat3b& image) {
  cv::Mat1f noise(image.size());
  rng.fill(noise, cv::RNG::NORMAL, 0.0, 1.0);
  cv::GaussianBlur(noise, noise, {0, 0}, softness);
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(noise, mean, deviation);
  cv::Mat3f grain;
  cv::cvtColor(noise * (contrast / std::max(deviation[0], 1e-9)), grain, cv::COLOR_GRAY2BGR);
  cv::Mat3f sum;
  image.convertTo(sum, CV_32FC3);
  sum += grain;
  sum.convertTo(image, CV_8UC3);
}

cv::Mat3b paintWood(const cv::Size& size, const cv::Scalar& mean, double contrast, cv::RNG& rng) {
  cv::Mat3b image = paintMottle(size, mean, 0.5 * contrast, rng);
  cv::Mat1f rings(size);
  cv::Mat1f bend(std::max(2, size.height / 60), 5);
  rng.fill(bend, cv::RNG::NORMAL, 0.0, 1.0);
  cv::resize(bend, bend, size, 0.0, 0.0, cv::INTER_CUBIC);
  const double pitch = rng.uniform(0.35, 0.5);
  for (int row = 0; row < size.height; ++row) {
    for (int x = 0; x < size.width; ++x) {
      const double phase = pitch * row + 4.0 * bend(row, x);
      rings(row, x) = static_cast<float>(
          contrast * (0.5 * std::sin(phase) + 0.3 * std::sin(0.31 * phase + 1.0)));
    }
  }
  cv::Mat1f fibres(size);
  rng.fill(fibres, cv::RNG::NORMAL, 0.0, 8.0 * contrast);
  cv::GaussianBlur(fibres, fibres, {0, 0}, 14.0, 0.7);
  cv::Mat3f grain;
  cv::cvtColor(rings + fibres, grain, cv::COLOR_GRAY2BGR);
  cv::Mat3f sum;
  image.convertTo(sum, CV_32FC3);
  sum += grain;
  sum.convertTo(image, CV_8UC3);
  return image;
}

void shadeUnevenly(double strength, cv::RNG& rng, cv::Mat3b& image) {
  const double from = rng.uniform(0.0, 2.0 * CV_PI);
  for (int row = 0; row < image.rows; ++row) {
    const double y = 2.0 * row / image.rows - 1.0;
    for (int column = 0; column < image.cols; ++column) {
      const double x = 2.0 * column / image.cols - 1.0;
      const double light = 1.0 + strength * (0.5 * (std::cos(from) * x + std::sin(from) * y) -
                                             0.3 * (x * x + y * y) + 0.1);
      for (int c = 0; c < 3; ++c) {
        image(row, column)[c] = cv::saturate_cast<uchar>(image(row, column)[c] * light);
      }
    }
  }
}

void tint(const cv::Mat1b& weight, const cv::Scalar& color, cv::Mat3b& image) {
  for (int row = 0; row < image.rows; ++row) {
    for (int x = 0; x < image.cols; ++x) {
      const double share = weight(row, x) / 255.0;
      for (int c = 0; c < 3; ++c) {
        image(row, x)[c] =
            cv::saturate_cast<uchar>((1.0 - share) * image(row, x)[c] + share * color[c]);
      }
    }
  }
}

void paintPrint(const cv::Rect& area, int line_height, const cv::Scalar& ink, cv::RNG& rng,
                cv::Mat3b& image) {
  const int height = std::max(1, line_height * 2 / 5);
  for (int y = area.y; y + height <= area.br().y; y += line_height) {
    const int end = area.x + cvRound(area.width * rng.uniform(0.6, 1.0));
    for (int x = area.x; x < end;) {
      const int width = std::min(rng.uniform(line_height / 2, 3 * line_height), end - x);
      if (width > 0) {
        const cv::Rect word(x, y, width, height);
        // Letters, not bars: strokes with gaps between.
        for (int stroke = word.x; stroke < word.br().x; stroke += std::max(2, height / 2)) {
          const int top = word.y + rng.uniform(0, std::max(1, height / 3));
          cv::rectangle(image, cv::Rect(stroke, top, std::max(1, height / 4), height), ink,
                        cv::FILLED);
        }
      }
      x += width + line_height / 2;
    }
  }
}

cv::Scalar randomColor(cv::RNG& rng) {
  return {rng.uniform(20.0, 235.0), rng.uniform(20.0, 235.0), rng.uniform(20.0, 235.0)};
}

cv::Scalar mutedColor(cv::RNG& rng) {
  const cv::Scalar color = randomColor(rng);
  const double grey = (color[0] + color[1] + color[2]) / 3.0;
  // Dyes and paints lean to the warm side.
  return 0.45 * color + 0.5 * cv::Scalar(0.85 * grey, 0.98 * grey, 1.1 * grey);
}

}  // namespace chain_tracker
