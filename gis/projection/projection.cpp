#include "gis/projection/projection.hpp"

#include "gis/projection/projection_map.hpp"

namespace coastmesh {

namespace {

struct Identity final : ProjectionMap {
  Identity() { description = "plane, coordinates as they are"; }
  Point forward(const Point& input) const override { return input; }
  Point inverse(const Point& plane) const override { return plane; }
  double scaleAt(const Point&) const override { return 1.0; }
  bool isIdentity() const override { return true; }
};

}  // namespace

Projection::Projection(std::shared_ptr<const ProjectionMap> impl) : impl_(std::move(impl)) {}

Projection Projection::plane() { return Projection(std::make_shared<Identity>()); }

Point Projection::forward(const Point& input) const { return impl_->forward(input); }
Point Projection::inverse(const Point& plane) const { return impl_->inverse(plane); }
double Projection::scaleAt(const Point& plane) const { return impl_->scaleAt(plane); }
Surface Projection::surface() const { return impl_->surface(); }
double Projection::measureAt(const Point& plane) const {
  return impl_->scaleAt(plane) * impl_->surface().shrinkAt(plane);
}
GroundPlaces Projection::groundPlaces(std::span<const Point> plane, const ItemLoop& loop) const {
  GroundPlaces places;
  if (!surface().isCurved()) return places;
  const auto makeRoom = [&](auto& items) {
    reserveOn(loop, items, plane.size());
    items.resize(plane.size());
  };
  makeRoom(places.input), makeRoom(places.space), makeRoom(places.measure);
  forEachByStretches(loop, plane.size(), [&](std::size_t i) {
    const GroundPlace at = impl_->groundAt(plane[i]);
    places.input[i] = at.input, places.space[i] = at.space, places.measure[i] = at.measure;
  });
  return places;
}
double Projection::smoothOver() const { return impl_->smoothOver(); }
std::optional<Point> Projection::infinity() const { return impl_->infinity(); }
bool Projection::isIdentity() const { return impl_->isIdentity(); }
bool Projection::mayTear() const { return impl_->mayTear(); }
const std::string& Projection::reason() const { return impl_->reason; }
const std::string& Projection::description() const { return impl_->description; }

}  // namespace coastmesh
