// The contacts of eight machines along one line of approach. Included inside the namespaces of
// lane_kernel.cpp: hence no #pragma once.
//
// Model  : lane_contact.hpp
// Units  : mm
// Errors : none

// The distance from the cutter and its derivatives, at a centre and a time.
struct FaceDistance {
  Number value;   // less the ball's radius: of the surface of the ball
  Number slope;   // along the planned normal
  Number rate;    // with tau
  Vector out;     // unit normal, out of the cutter
  Number height;  // above the tip, of the point that touches
  Number rho;     // from the tool's axis
};

// A piece of motion as parabolas.
struct PieceMotion {
  Vector tip0, tip1, tip2, axis0, axis1, axis2;

  static inline Vector first(const Vector& a, const Vector& b, const Vector& c) {
    return {4.0 * b.x - 3.0 * a.x - c.x, 4.0 * b.y - 3.0 * a.y - c.y, 4.0 * b.z - 3.0 * a.z - c.z};
  }
  static inline Vector second(const Vector& a, const Vector& b, const Vector& c) {
    return {2.0 * (a.x + c.x) - 4.0 * b.x, 2.0 * (a.y + c.y) - 4.0 * b.y,
            2.0 * (a.z + c.z) - 4.0 * b.z};
  }
  PieceMotion(const Place& a, const Place& b, const Place& c)
      : tip0(a.tip),
        tip1(first(a.tip, b.tip, c.tip)),
        tip2(second(a.tip, b.tip, c.tip)),
        axis0(a.axis),
        axis1(first(a.axis, b.axis, c.axis)),
        axis2(second(a.axis, b.axis, c.axis)) {}

  static inline Vector at(const Vector& p0, const Vector& p1, const Vector& p2, const Number& tau) {
    return sum(p0, times(tau, sum(p1, times(tau, p2))));
  }
  inline Vector tip(const Number& tau) const { return at(tip0, tip1, tip2, tau); }
  // The parabola is a unit vector within 1e-8: one step of Newton for the square root is exact.
  inline Vector axis(const Number& tau) const {
    const Vector a = at(axis0, axis1, axis2, tau);
    return times(1.5 - 0.5 * dot(a, a), a);
  }
  static inline Vector rate(const Vector& p1, const Vector& p2, const Number& tau) {
    return sum(p1, times(2.0 * tau, p2));
  }
};

// Of a point from the face, continued beyond its ends.
static inline FaceDistance from_face(const LaneFace& face, const Vector& m, const Vector& axis,
                                     const Number& ball) {
  const Number z = dot(m, axis);
  const Vector across = difference(m, times(z, axis));
  const Number rho = root(dot(across, across));
  FaceDistance d;
  d.rho = rho;
  Number lateral, axial;
  if (face.is_round) {
    const Number beside = rho - face.major, above = z - face.centre;
    const Number away = root(beside * beside + above * above);
    lateral = beside / away;
    axial = above / away;
    d.value = away - face.radius + ball;
  } else {
    lateral = all(face.cosine);
    axial = all(-face.sine);
    d.value = (rho - (face.radius + face.slope * (z - face.z_lo))) * face.cosine + ball;
  }
  d.out = sum(times(lateral / rho, across), times(axial, axis));
  d.height = z + ball * axial;
  // What the axis adds to the rate for each unit of m . axis'.
  d.rate = axial - lateral * z / rho;
  return d;
}

static inline FaceDistance distance_at(const LaneFace& face, const PieceMotion& piece,
                                       const Vector& centre, const Vector& normal,
                                       const Number& ball, const Number& tau) {
  const Vector m = difference(centre, piece.tip(tau));
  FaceDistance d = from_face(face, m, piece.axis(tau), ball);
  d.slope = dot(d.out, normal);
  d.rate = dot(m, PieceMotion::rate(piece.axis1, piece.axis2, tau)) * d.rate -
           dot(d.out, PieceMotion::rate(piece.tip1, piece.tip2, tau));
  return d;
}

struct PieceContact {
  Number travel, missed;  // mm; what the solution may be off
  FaceDistance at;
};

// Steps of Newton for the travel and tau at once, tau held within the piece.
static inline PieceContact contact_on(const LaneFace& face, const PieceMotion& motion,
                                      const LanePiece& piece, const Vector& touching,
                                      const Vector& normal, const Number& ball, double travel) {
  constexpr int kSteps = 3;  // from a tenth of a piece to 1e-10 mm
  const Number zero = all(0.0), one = all(1.0);
  const double per_bend = 1.0 / piece.bend;
  Number v = all(travel), tau = all(piece.tau), step = zero;
  PieceContact found;
  for (int i = 0;; ++i) {
    const Vector centre = sum(touching, times(v, normal));
    found.at = distance_at(face, motion, centre, normal, ball, tau);
    step = smaller(larger(tau - found.at.rate * per_bend, zero), one) - tau;
    if (i == kSteps) break;
    v -= found.at.value / found.at.slope;
    tau += step;
  }
  // The rest of the way, as a parabola in tau.
  const Number rest = found.at.value + step * (found.at.rate + 0.5 * piece.bend * step);
  found.travel = v - rest / found.at.slope;
  // The bend is known to a few parts in a hundred.
  found.missed = size_of(0.1 * piece.bend * step * step / found.at.slope) +
                 size_of(rest * rest / (found.at.rho * found.at.slope));
  return found;
}

// One line of approach.
class ContactSearch {
 public:
  ContactSearch(const ProbeWindow& window, const WindowTables& tables,
                std::span<const LanePose> poses, const LaneFrame& frame, const Lanes& scale,
                std::size_t first)
      : window_(window),
        pieces_(tables.pieces.data() + window.first_piece),
        face_(tables.faces[window.face]),
        poses_(poses),
        scale_(load(scale, first)),
        first_(first),
        ball_(all(window.ball)) {
    const Vector n = all(window.normal.data()), p = all(window.point.data());
    normal_ = turned(frame, n);
    touching_ = sum(sum(turned(frame, p), load(frame.origin, first)), times(ball_, normal_));
  }

  void search_into(LaneContact& contact) {
    find_deepest();
    settle_on_edges();
    const Vector centre = sum(touching_, times(travel_, normal_));
    touched_ = sum(centre, times(ball_, best_.out));
    const Number drifted = drift();
    doubt_if(missed_ < 1e-9, Doubt::unsettled);
    doubt_if((best_.height > face_.z_lo) & (best_.height < face_.z_hi), Doubt::off_face);
    doubt_if(keeps_away(window_.others, drifted, moved()), Doubt::others);
    if (window_.is_open_before) {
      const Number nearer = window_.at_first - end_distance(pieces_[0].node[0], drifted);
      doubt_if(keeps_away(window_.before, drifted, nearer), Doubt::before);
    }
    if (window_.is_open_after) {
      const Number nearer =
          window_.at_last - end_distance(pieces_[window_.pieces - 1].node[2], drifted);
      doubt_if(keeps_away(window_.after, drifted, nearer), Doubt::after);
    }
    store(contact.travel, first_, travel_);
    for (std::size_t i = 0; i < kWidth; ++i) {
      contact.doubt[first_ + i] = static_cast<std::uint32_t>(doubt_[i]);
    }
  }

 private:
  static constexpr std::uint32_t kMostPieces = 12;

  inline Vector turned(const LaneFrame& frame, const Vector& v) const {
    return sum(sum(times(v.x, load(frame.x, first_)), times(v.y, load(frame.y, first_))),
               times(v.z, load(frame.z, first_)));
  }

  Place place(std::uint32_t node) const {
    return {load(poses_[node].tip, first_), load(poses_[node].axis, first_)};
  }
  PieceMotion motion_of(const LanePiece& piece) const {
    return {place(piece.node[0]), place(piece.node[1]), place(piece.node[2])};
  }

  // `holds`: a comparison that a number that is none fails.
  inline void doubt_if(const Mask& holds, Doubt doubt) {
    doubt_ |= ~holds & (static_cast<std::int64_t>(doubt) - Mask{});
  }

  void find_deepest() {
    for (std::uint32_t k = 0; k < window_.pieces; ++k) {
      const PieceMotion motion = motion_of(pieces_[k]);
      const PieceContact found =
          contact_on(face_, motion, pieces_[k], touching_, normal_, ball_, window_.travel);
      if (k == window_.own_piece) keep_own_pose(motion, pieces_[k].tau);
      contacts_[k] = found;
      if (k == 0) {
        travel_ = found.travel;
        missed_ = found.missed;
        best_ = found.at;
        continue;
      }
      const Mask deeper = found.travel < travel_;
      travel_ = either(deeper, found.travel, travel_);
      missed_ = larger(missed_, found.missed);
      best_.out = chosen(deeper, found.at.out, best_.out);
      best_.slope = either(deeper, found.at.slope, best_.slope);
      best_.height = either(deeper, found.at.height, best_.height);
      best_.rho = either(deeper, found.at.rho, best_.rho);
    }
  }

  // The ball is held by planes that touch it at the deepest contact and at another piece's. Where
  // it would pass the line in which both planes meet it rests on that line:
  // (a^2 + b^2 - 2 a b cos) / sin^2 = ball^2 with the centre a and b off both planes.
  void settle_on_edges() {
    const Number zero = all(0.0);
    const Number deepest = travel_;
    Number edges = zero, deeper = zero;
    for (std::uint32_t k = 0; k < window_.pieces; ++k) {
      const FaceDistance& other = contacts_[k].at;
      const Vector apart = difference(best_.out, other.out);
      const Number lost = 0.5 * dot(apart, apart);  // 1 - cos
      const Number gap = (deepest - contacts_[k].travel) * other.slope;
      const Number e = ball_ * lost - gap;
      // An edge that holds the ball by less than this is none (mm).
      const Mask is_edge = (e > 1e-11) & (contacts_[k].travel > deepest);
      const Number a = -best_.slope, b = -other.slope;
      const Number half = a * (ball_ * lost + gap * (1.0 - lost)) + b * e;
      const Number square = (a - b) * (a - b) + 2.0 * a * b * lost;
      const Number inside = half * half - square * e * e;
      const Number by = e * e / (half + root(larger(inside, zero)));
      deeper = larger(deeper, either(is_edge, by, zero));
      edges += either(is_edge, all(1.0), zero);
      // Between the planes and the surfaces that they touch, over the way to the edge (mm).
      const Number bulge = ball_ * ball_ * lost / (4.0 * (best_.rho + ball_));
      doubt_if(~is_edge | (bulge < 3e-7), Doubt::edges);
    }
    travel_ = deepest - deeper;
    doubt_if(edges < 1.5, Doubt::edges);
  }

  // Where the middle machine's contact is now on the cutter that made it.
  void keep_own_pose(const PieceMotion& motion, double tau) {
    own_tip_ = motion.tip(all(tau));
    own_axis_ = motion.axis(all(tau));
  }

  Number drift() const {
    const Vector tip = all(window_.tip.data()), axis = all(window_.axis.data());
    const Vector touched = all(window_.touched.data());
    const Vector m = difference(touched, tip), turn = difference(own_axis_, axis);
    const Number z = dot(m, axis);
    const Vector carried =
        sum(difference(own_tip_, tip), difference(times(z, turn), times(dot(m, turn), axis)));
    const Vector off = difference(difference(touched_, touched), carried);
    return root(dot(off, off));
  }

  // The contact, in the workpiece.
  Number moved() const {
    const Vector off = difference(touched_, all(window_.touched.data()));
    return root(dot(off, off));
  }

  // Of the contact from the plane that touches the cutter at an end of the window, at least.
  Number end_distance(std::uint32_t node, const Number& drift) const {
    const Place pose = place(node);
    const FaceDistance d = from_face(face_, difference(touched_, pose.tip), pose.axis, all(0.0));
    return d.value - 0.5 * drift * drift / d.rho;
  }

  Mask keeps_away(const Closeness& from, const Number& drift, const Number& nearer) const {
    return from.per_scale * scale_ + from.per_drift * drift +
               from.per_nearer * larger(nearer, all(0.0)) <
           1.0;
  }

  const ProbeWindow& window_;
  const LanePiece* pieces_;
  const LaneFace& face_;
  std::span<const LanePose> poses_;
  Number scale_;
  std::size_t first_;
  Number ball_;
  Vector normal_, touching_;
  PieceContact contacts_[kMostPieces];
  Number travel_, missed_;
  FaceDistance best_;
  Vector own_tip_, own_axis_, touched_;
  Mask doubt_{};
};

static void find_contacts_here(std::span<const ProbeWindow> windows, const WindowTables& tables,
                               std::span<const LanePose> poses, const LaneFrame& frame,
                               const Lanes& scale, std::span<LaneContact> contacts) {
  for (std::size_t i = 0; i < windows.size(); ++i) {
    for (std::size_t first = 0; first < kLanes; first += kWidth) {
      ContactSearch(windows[i], tables, poses, frame, scale, first).search_into(contacts[i]);
    }
  }
}
