// SPDX-License-Identifier: BSD-3-Clause
#include "scene_backgrounds.h"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "scene_textures.h"

namespace chain_tracker {
namespace {

/// Sizes below are told for an image 480 px high.
double unitOf(const cv::Size& size) { return std::min(size.width, size.height) / 480.0; }

cv::Point randomPoint(const cv::Size& size, cv::RNG& rng) {
  const int x = rng.uniform(0, size.width);
  return {x, rng.uniform(0, size.height)};
}

void soften(double sigma, cv::Mat3b& image) {
  cv::GaussianBlur(image, image, {0, 0}, std::max(0.3, sigma));
}

/// Darkens what lies under a thing with these corners.
void shadowBelow(const std::vector<cv::Point>& corners, double unit, cv::Mat3b& image) {
  cv::Mat1b shadow(image.size(), uchar(0));
  cv::fillConvexPoly(shadow, corners, 120);
  cv::GaussianBlur(shadow, shadow, {0, 0}, 4.0 * unit);
  tint(shadow, {15.0, 15.0, 18.0}, image);
}

/// A sheet of paper with print, turned.
void laySheet(const cv::Size& sheet_size, double unit, cv::RNG& rng, cv::Mat3b& image) {
  cv::Mat3b sheet = paintMottle(sheet_size, {222.0, 230.0, 232.0}, 2.5, rng);
  const int margin = sheet_size.width / 10;
  paintPrint({margin, margin, sheet_size.width - 2 * margin, sheet_size.height - 2 * margin},
             std::max(5, cvRound(11.0 * unit)), {85.0, 75.0, 70.0}, rng, sheet);
  const double angle = rng.uniform(-0.6, 0.6);
  const cv::Point2d at = randomPoint(image.size(), rng);
  const cv::Matx23d place(std::cos(angle), -std::sin(angle), at.x - 0.5 * sheet_size.width,
                          std::sin(angle), std::cos(angle), at.y - 0.5 * sheet_size.height);
  std::vector<cv::Point> corners;
  for (const cv::Point2d& corner :
       {cv::Point2d(0, 0), cv::Point2d(sheet_size.width, 0),
        cv::Point2d(sheet_size.width, sheet_size.height), cv::Point2d(0, sheet_size.height)}) {
    const cv::Vec2d moved = place * cv::Vec3d(corner.x, corner.y, 1.0);
    corners.emplace_back(cvRound(moved[0] + 3.0 * unit), cvRound(moved[1] + 4.0 * unit));
  }
  shadowBelow(corners, unit, image);
  cv::warpAffine(sheet, image, place, image.size(), cv::INTER_LINEAR, cv::BORDER_TRANSPARENT);
}

}  // namespace

cv::Mat3b paintWall(const cv::Size& size, cv::RNG& rng) {
  cv::Mat3b wall = paintNoise(size, {150.0, 160.0, 165.0}, 14.0, rng);
  for (int i = 0; i < 14; ++i) {
    const cv::RotatedRect blob(
        cv::Point2f(rng.uniform(0.0F, 1.0F) * static_cast<float>(size.width),
                    rng.uniform(0.0F, 1.0F) * static_cast<float>(size.height)),
        cv::Size2f(rng.uniform(20.0F, 130.0F), rng.uniform(20.0F, 90.0F)),
        rng.uniform(0.0F, 180.0F));
    cv::Mat3b painted = wall.clone();
    cv::ellipse(painted, blob, randomColor(rng), cv::FILLED, cv::LINE_AA);
    cv::addWeighted(painted, 0.7, wall, 0.3, 0.0, wall);
  }
  return wall;
}

cv::Mat3b paintDesk(const cv::Size& size, cv::RNG& rng) {
  const double unit = unitOf(size);
  cv::Mat3b desk = paintWood(size, {75.0, 115.0, 160.0}, 9.0, rng);
  for (int i = 0; i < 3; ++i) {
    laySheet({cvRound(unit * rng.uniform(110.0, 190.0)), cvRound(unit * rng.uniform(140.0, 230.0))},
             unit, rng, desk);
  }
  // The ring that a cup left.
  cv::Mat1b stain(size, uchar(0));
  cv::circle(stain, randomPoint(size, rng), cvRound(38.0 * unit), 90,
             std::max(1, cvRound(4 * unit)), cv::LINE_AA);
  cv::GaussianBlur(stain, stain, {0, 0}, 1.5);
  tint(stain, {25.0, 45.0, 75.0}, desk);
  addGrain(2.5, 0.8, rng, desk);
  soften(0.6 * unit, desk);
  shadeUnevenly(0.4, rng, desk);
  return desk;
}

cv::Mat3b paintWorkshop(const cv::Size& size, cv::RNG& rng) {
  const double unit = unitOf(size);
  const auto px = [&](double length) { return cvRound(length * unit); };
  const auto stroke = [&](double width) { return std::max(1, px(width)); };
  cv::Mat3b hall = paintMottle(size, {128.0, 132.0, 130.0}, 9.0, rng);
  const int floor = size.height * 7 / 10;
  const cv::Rect ground(0, floor, size.width, size.height - floor);
  paintMottle(ground.size(), {92.0, 100.0, 104.0}, 10.0, rng).copyTo(hall(ground));
  for (int x = 0; x < size.width; x += px(120.0)) {
    cv::line(hall, {x, 0}, {x, floor}, {105.0, 108.0, 108.0}, stroke(3.0));
  }
  for (int i = 0; i < 9; ++i) {
    const cv::Size crate(px(rng.uniform(40.0, 120.0)), px(rng.uniform(40.0, 150.0)));
    const cv::Point corner(rng.uniform(-40, size.width), floor - crate.height + px(15.0));
    const cv::Scalar color = 0.8 * mutedColor(rng) + cv::Scalar(15.0, 18.0, 20.0);
    cv::rectangle(hall, cv::Rect(corner, crate), color, cv::FILLED);
    cv::rectangle(hall, cv::Rect(corner, crate), 0.6 * color, stroke(3.0));
    cv::rectangle(hall, cv::Rect(corner, cv::Size(crate.width, px(7.0))), 1.25 * color, cv::FILLED);
    cv::rectangle(hall,
                  cv::Rect(corner + cv::Point(crate.width / 5, crate.height / 3),
                           cv::Size(crate.width / 3, px(14.0))),
                  {190.0, 200.0, 205.0}, cv::FILLED);
  }
  for (int i = 0; i < 4; ++i) {
    const int y = px(rng.uniform(15.0, 160.0));
    const cv::Scalar color(rng.uniform(90.0, 190.0), rng.uniform(90.0, 180.0),
                           rng.uniform(80.0, 190.0));
    cv::line(hall, {0, y}, {size.width, y + px(rng.uniform(-8.0, 8.0))}, color, stroke(9.0));
    cv::line(hall, {0, y - px(3.0)}, {size.width, y - px(3.0)}, 1.2 * color, stroke(2.0));
  }
  cv::line(hall, {0, floor + px(50.0)}, {size.width, floor + px(90.0)}, {60.0, 190.0, 215.0},
           stroke(10.0));
  soften(2.6 * unit, hall);
  addGrain(1.5, 1.0, rng, hall);
  shadeUnevenly(0.5, rng, hall);
  return hall;
}

cv::Mat3b paintBookcase(const cv::Size& size, cv::RNG& rng) {
  const double unit = unitOf(size);
  const auto px = [&](double length) { return cvRound(length * unit); };
  cv::Mat3b shelves = paintMottle(size, {38.0, 46.0, 58.0}, 6.0, rng);
  const int pitch = px(150.0);
  for (int top = -px(40.0); top < size.height; top += pitch) {
    for (int x = 0; x < size.width;) {
      const int width = px(rng.uniform(12.0, 34.0));
      const int height = px(rng.uniform(95.0, 128.0));
      const cv::Rect spine(x, top + pitch - px(14.0) - height, width, height);
      const cv::Scalar color = 0.9 * mutedColor(rng);
      if (rng.uniform(0, 9) > 0) {
        cv::rectangle(shelves, spine, color, cv::FILLED);
        cv::rectangle(shelves, cv::Rect(x, spine.y + height / 6, width, px(8.0)),
                      cv::Scalar::all(255.0) - 0.6 * color, cv::FILLED);
        cv::rectangle(shelves,
                      cv::Rect(x + width * 2 / 5, spine.y + height / 3, width / 4, height * 2 / 5),
                      {200.0, 215.0, 220.0}, cv::FILLED);
        cv::rectangle(shelves, cv::Rect(x, spine.y, std::max(1, px(3.0)), height), 0.5 * color,
                      cv::FILLED);
      }
      x += width + px(1.0);
    }
    cv::rectangle(shelves, cv::Rect(0, top + pitch - px(14.0), size.width, px(14.0)),
                  {70.0, 105.0, 140.0}, cv::FILLED);
  }
  soften(3.2 * unit, shelves);
  addGrain(1.5, 1.0, rng, shelves);
  shadeUnevenly(0.5, rng, shelves);
  return shelves;
}

cv::Mat3b paintTissue(const cv::Size& size, cv::RNG& rng) {
  const double unit = unitOf(size);
  cv::Mat3b tissue = paintMottle(size, {105.0, 110.0, 195.0}, 15.0, rng);
  addGrain(7.0, 2.5 * unit, rng, tissue);
  cv::Mat1b vessels(size, uchar(0));
  for (int i = 0; i < 16; ++i) {
    cv::Point2d at = randomPoint(size, rng);
    double heading = rng.uniform(0.0, 2.0 * CV_PI);
    const double width = rng.uniform(1.0, 4.0) * unit;
    for (int step = 0; step < 60; ++step) {
      heading += rng.gaussian(0.22);
      const cv::Point2d next = at + 6.0 * unit * cv::Point2d(std::cos(heading), std::sin(heading));
      cv::line(vessels, at, next, 170, std::max(1, cvRound(width * (1.0 - step / 70.0))),
               cv::LINE_AA);
      at = next;
    }
  }
  cv::GaussianBlur(vessels, vessels, {0, 0}, 1.2 * unit);
  tint(vessels, {45.0, 35.0, 135.0}, tissue);
  for (int i = 0; i < 9; ++i) {
    cv::Mat1b fat(size, uchar(0));
    cv::ellipse(fat, randomPoint(size, rng),
                {cvRound(rng.uniform(15.0, 70.0) * unit), cvRound(rng.uniform(10.0, 40.0) * unit)},
                rng.uniform(0.0, 180.0), 0.0, 360.0, 120, cv::FILLED);
    cv::GaussianBlur(fat, fat, {0, 0}, 9.0 * unit);
    tint(fat, {140.0, 190.0, 225.0}, tissue);
  }
  cv::Mat1b glints(size, uchar(0));
  for (int i = 0; i < 26; ++i) {
    cv::ellipse(glints, randomPoint(size, rng),
                {cvRound(rng.uniform(1.0, 9.0) * unit), cvRound(rng.uniform(1.0, 3.0) * unit)},
                rng.uniform(0.0, 180.0), 0.0, 360.0, 230, cv::FILLED, cv::LINE_AA);
  }
  cv::GaussianBlur(glints, glints, {0, 0}, 1.3 * unit);
  tint(glints, {240.0, 240.0, 250.0}, tissue);
  shadeUnevenly(0.7, rng, tissue);
  return tissue;
}

cv::Mat3b paintDimRoom(const cv::Size& size, cv::RNG& rng) {
  const double unit = unitOf(size);
  cv::Mat3b room = paintMottle(size, {48.0, 46.0, 52.0}, 10.0, rng);
  for (int i = 0; i < 14; ++i) {
    cv::Mat1b lamp(size, uchar(0));
    cv::circle(lamp, randomPoint(size, rng), cvRound(rng.uniform(10.0, 45.0) * unit),
               rng.uniform(40.0, 130.0), cv::FILLED, cv::LINE_AA);
    cv::GaussianBlur(lamp, lamp, {0, 0}, 2.5 * unit);
    tint(lamp, {rng.uniform(60.0, 190.0), rng.uniform(110.0, 190.0), rng.uniform(150.0, 240.0)},
         room);
  }
  soften(3.0 * unit, room);
  addGrain(1.5, 1.0, rng, room);
  return room;
}

cv::Mat3b paintStreet(const cv::Size& size, cv::RNG& rng) {
  const double unit = unitOf(size);
  cv::Mat3b street = paintMottle(size, {118.0, 118.0, 115.0}, 8.0, rng);
  addGrain(13.0, 0.9 * unit, rng, street);
  const int kerb = size.height * 3 / 10;
  const cv::Rect lawn(0, 0, size.width, kerb);
  cv::Mat3b grass = paintMottle(lawn.size(), {45.0, 105.0, 80.0}, 16.0, rng);
  addGrain(22.0, 1.2 * unit, rng, grass);
  grass.copyTo(street(lawn));
  const cv::Rect stone(0, kerb, size.width, std::max(1, cvRound(22.0 * unit)));
  cv::Mat3b stones = paintMottle(stone.size(), {165.0, 170.0, 172.0}, 7.0, rng);
  addGrain(7.0, 0.8, rng, stones);
  stones.copyTo(street(stone));
  for (int x = 0; x < size.width; x += cvRound(95.0 * unit)) {
    cv::line(street, {x, stone.y}, {x, stone.br().y}, {95.0, 95.0, 95.0}, 2, cv::LINE_AA);
  }
  cv::Mat1b gutter(size, uchar(0));
  cv::rectangle(gutter, cv::Rect(0, stone.br().y, size.width, cvRound(8.0 * unit)), 150,
                cv::FILLED);
  cv::GaussianBlur(gutter, gutter, {0, 0}, 3.0 * unit);
  tint(gutter, {40.0, 42.0, 45.0}, street);
  for (int i = 0; i < 60; ++i) {
    const cv::Point at = randomPoint(size, rng);
    const cv::Size half(cvRound(rng.uniform(3.0, 8.0) * unit),
                        cvRound(rng.uniform(2.0, 4.0) * unit));
    cv::ellipse(street, at, half, rng.uniform(0.0, 180.0), 0.0, 360.0,
                {rng.uniform(20.0, 60.0), rng.uniform(70.0, 140.0), rng.uniform(110.0, 190.0)},
                cv::FILLED, cv::LINE_AA);
  }
  soften(0.7 * unit, street);
  shadeUnevenly(0.4, rng, street);
  return street;
}

}  // namespace chain_tracker
