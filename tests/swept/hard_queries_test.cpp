/// Queries that once got a wrong answer, found by feeding raw numbers to every pair.

#include <algorithm>
#include <functional>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include <thinwall/discrete/boxes/box_manifold.hpp>
#include <thinwall/discrete/queries.hpp>
#include <thinwall/swept/methods/centre_ray.hpp>
#include <thinwall/swept/time_of_impact.hpp>

#include "support/judge.hpp"
#include "support/shaker.hpp"

namespace thinwall {

namespace {

using V = Vec3<double>;
using F = Vec3<float>;

// ---- Two shapes in motion: what is known of the answer, to whichever is asked first and at any power of two of their size.

struct Answer {
  std::vector<ToiStatus> may_be;  ///< more than one where the truth is nearer than rounding
  double time, within;            ///< of the time that 50 digits give; 0 wants its very bits
};
struct Finding {
  const char* about;
  std::function<Toi<double>(bool turned, int scale)> ask;  ///< scale: [tenths of the scalar's range of exponents]
  Answer truth;
};

template <class A, class B> auto asking(const Moving<A>& a, const Moving<B>& b) {
  return [=](bool turned, int scale) {
    const int exponent = scale * std::numeric_limits<typename A::Scalar>::max_exponent / 10;
    const auto first = scaled(a, exponent);
    const auto second = scaled(b, exponent);
    const auto toi = turned ? time_of_impact(second, first) : time_of_impact(first, second);
    return Toi<double>{toi.status, 0, toi.time, (turned ? -1 : 1) * toi.normal.template cast<double>(), V::Zero()};
  };
}

using enum ToiStatus;

Mat3<double> leaning(const V& x, const V& y, const V& z) {
  Mat3<double> axes;
  axes << x, y, z;
  return axes;
}

const Moving long_capsule{Capsule<double>{V(1, -0x1p+31, 0x1.fffffep-1), V(0, 2, 3), 0x1.000002p+0},
                          V(0x1.602p+2, 0x1p+30, -0x1.6cccccp+3)};
const Aabb<double> low_box{V(0x1.802p+2, -2, -0x1.2cccccp+3), V(1, 3, 2)};

const std::vector<Finding> findings = {
    {"nothing overlaps from far away, however coarse the times",
     asking(Moving{Capsule<double>{V(-0.8, -0.8, -0.8), V(-0.6, -0.8, -0.8), 0.8}, V(4, 2, 3)},
            Moving{Sphere<double>{V(10.2, -0x1p+57, 2.1), 1.2}, V(-7, 0x1p+57, 0.09)}),
     {{apart, hit}, 1, 1e-3}},
    {"points that meet at the end do not overlap at the start",
     asking(Moving{Capsule<double>{V(0, 0, 0), V(0, 0, 0), 0}, V(0, 0.8, 0)},
            at_rest(Aabb<double>{V(0, 0.8, 0), V(0, 0, 0)})),
     {{hit}, 1, 0}},
    {"nor do they if one is a segment as short",
     asking(at_rest(Capsule<double>{V(0x1p-50, 0, 0), V(0, 0, 0), 0}),
            Moving{Sphere<double>{V(0x1p-50, 8, 256), 0}, V(-0x1p-50, -8, -256)}),
     {{hit}, 1, 0x1p-52}},
    {"a thin capsule, almost along an edge of a box, meets where the edge ends",
     asking(Moving{Capsule<double>{V(0x1.0fbf035c3f2c9p+1, 0x1.05adf0e392c0cp+1, -0x1.4454f9462a18p-2),
                                   V(0x1.0fbf035ceb357p+1, 0x1.05adf0da892f8p+1, 0x1.d7b8229751298p-1), 0x1p-27},
                   V(-0x1.42d103e60f4fcp-1, -0x1.838d5719c7862p-1, -0x1.ae346c16be1d4p-31)},
            at_rest(Aabb<double>{V::Zero(), V(0x1.f3b22dbd35852p+0, 0x1.d6c7adc46bcaep+0, 0x1.63cc2d78d7d76p-1)})),
     {{hit}, 0.2713385642627759597674957, 1e-15}},
    {"and one that leans from a face by less than rounding meets where the face ends",
     asking(Moving{Capsule<double>{V(0x1.34daadcb57426p+1, -0x1.d2576842b949dp-1, 0x1.1a3f9816e76eep-2),
                                   V(0x1.cd9f32cf080e3p+0, -0x1.d257684121d0bp-1, 0x1.5734d069c68d2p+0),
                                   0x1.4a8ed31f9ae7ap-25},
                   V(0x1.e1d06de0f9a97p-3, 0x1.97c3b9f2acde7p-1, -0x1.1d3df5153446cp-1)},
            at_rest(Aabb<double>{V::Zero(), V(0x1.fcf2f039a0505p+0, 0x1.23c710486a606p-1, 0x1.fad2e43449c94p-1)})),
     {{hit}, 0.42809954921084305367, 2e-16}},
    {"a plane of no contact settles nothing: a plate and a tile would meet at 1 + 2^-52",
     asking(
         Moving{Aabb<double>{V(0x1.c808a8p-2, 2, 1), V(0.8, 0, 0)}, V(5, -0x1.fffffffffffffp-2, -0x1.8262126666666p-1)},
         Moving{Aabb<double>{V(0x1.3ecef6ccccccdp+0, 1.5, 0x1.1f677b6666668p+1), V(7, 0, 5)}, V(5, 0, -7)}),
     {{apart}, 1, 0}},
    {"a corner without a radius meets a slab as the step ends",
     asking(Moving{Aabb<double>{V(-8, 0, -3), V(8, 3, 0)}, V(-256, -1, 11)},
            at_rest(Aabb<double>{V(-256, -4, 0x1.f99999999999ap+2), V(0, 0, 0.1)})),
     {{hit}, 1, 0}},
    {"a segment in touch to rounding has come in",
     asking(Moving{Capsule<float>{F(0.5F, -0.5F, 0x1.7e77fcp-1F), F(1, 8.5F, -0x1.ef4dap-1F), 0},
                   F(0x1.3f3cp+0F, 0x1p-4F, 256)},
            Moving{Triangle<float>{F(0x1.7fd4fp-2F, 0x1.88fcc8p+1F, 0x1.f2121p-1F),
                                   F(0x1.97fd5p+2F, 0x1.50f58ep+0F, -0x1.c37b7cp+1F),
                                   F(0x1.ae729ap+1F, 0x1.846e66p+2F, 0x1.4f2122p+3F)},
                   F(0x1.f2ecp-8F, 0.5F, 0x1.800002p+1F)}),
     {{hit}, 0x1.4f367063fc983p-9, 0x1p-31}},
    {"a large triangle is seen from its nearest corner",
     asking(Moving{Triangle<double>{V(-0x1p+57, 0.7, 896), V(896, -0x1p-5, 0.7), V(0, -896, 896)}, V(-0.8, -0.8, -0.8)},
            Moving{Sphere<double>{V(0x1.34f71d957adbep+8, -0x1.33ea38d044248p+9, -0x1.2d23585adad07p+10), 0.8},
                   V(-0.8, 28, 1792)}),
     {{hit}, 0x1.ff6795830afebp-1, 1e-14}},
    {"a far path",
     asking(Moving{Triangle<double>{V(2, -5, 4), V(-4, -0x1p-24, 1.456), V(-7, -3.818, -32)}, V(-0.818, 510, 9.25)},
            Moving{Sphere<double>{V(-3.818, 512, 0), 2.5}, V(0x1p-24, -4.9, 0x1p-24)}),
     {{hit}, 0.5, 0.5}},
    {"a long segment almost along an edge",
     asking(long_capsule, at_rest(low_box)),
     {{hit}, 0x1.87c07d7f53c46p-1, 1e-15}},
    {"the same of an oriented box",
     asking(long_capsule, at_rest(to_obb(low_box))),
     {{hit}, 0x1.87c07d7f53c46p-1, 1e-15}},
    {"a segment that starts on a triangle and goes in hits it",  // truly at 3.6e-18
     asking(Moving{Capsule<double>{V(2, -8, -9), V(-8, 0, -0x1p-5), 0}, V(2, 0, 0x1.8000000008p+1)},
            Moving{Triangle<double>{V(-0x1.7d9601fda252ap+2, -0x1.38c4a93b8ae3ap+1, -0x1.30365c4f767ddp+0),
                                    V(-0x1.bb2c03fb44a54p+1, 0x1.d161537bd427dp+2, -0x1.a2d39856bb9c8p+3),
                                    V(0x1.84d3fc04bb5acp+1, 0x1.5f1ee788ea38cp+0, 0x1.67e4d1d844c12p+1)},
                   V(-6, -0x1.14e50cp-1, 0.3)}),
     {{hit}, 0, 1e-16}},
    {"a segment that seems to recede once it is there hits the triangle",
     asking(Moving{Capsule<double>{V(-9.2, 0x1.80000000002p+1, 0), V(0, -0x1.838d78p-2, 0), 0},
                   V(0x1.4888888888888p+3, -0x1.c1a84c5aaaacbp+4, -0x1.4409794p+3)},
            Moving{Triangle<double>{V(1, -0x1.838d78p-2, -9.2), V(16, -64, -5.6), V(0, -16, -0x1.3282d22666666p+3)},
                   V(0, 0, -2)}),
     {{hit}, 0x1.e7bf7f7befa87p-1, 0x1p-50}},
    {"a segment that starts on a plate touches it",
     asking(Moving{Capsule<float>{F(2, -5, -2), F(-0.2F, 2, 0.2F), 0}, F(-7, -2, 3)},
            at_rest(Aabb<float>{F(0x1.1d14ap-3F, 0.75F, -0.5F), F(0, 0.75F, 4.6F)})),
     {{hit, overlapping}, 0, 1e-7}},
    {"a segment through a box overlaps it, though its way in is the closest point found",
     asking(Moving{Capsule<double>{V(-0.6, -8, 5), V(-0.6, -0x1.64ec8p-1, -0x1.8p-4), 0}, V(0.5, -2.6, 2.5)},
            at_rest(Aabb<double>{V(-0x1.8dca66666666p-4, -7, 5), V(2, 0.7, 0x1.4d89cp+0)})),
     {{overlapping}, 0, 0}},
    {"a triangle with two equal corners",
     asking(
         Moving{Sphere<double>{V(-0.8, -0x1.0f135cf53a706p+3, 0x1.55cb443f674eep+1), 0.8}, V(-0x1.ecabc4p-1, 0.4, -3)},
         Moving{Triangle<double>{V(-8, -0.8, -0.8), V(-0.8, -0.8, -0.8), V(-0.8, -0.8, -0.8)}, V(0, -8, 0.8)}),
     {{hit}, 0.5, 0.5}},
    {"boxes that pass corner by corner, by 6 u, do not hit, though the turned one's arithmetic said they do",
     asking(Moving{Obb<double>{V(-0x1.3333333333334p-2, 8, -0x1.999999999999ap-1),
                               V(0x1.3333333333334p-2, 0x1.999999999999ap-2, 0x1.3333333333334p-2),
                               Mat3<double>::Identity()},
                   V(-0x1.bfffp+2, -0x1.ccccccccccccep-1, -0x1.b4fc44p-1)},
            Moving{Aabb<double>{V(-0x1.2324552d524ddp-2, -0x1.5a49d3006dae8p-2, 0x1.999999999999ap-1),
                                V(0x1.3333333333334p-2, 0x1.fp+2, 0x1.804p+2)},
                   V(-0x1.199999999999ap+0, 1, -0x1.b4fc43fffffffp-1)}),
     {{apart}, 1, 0}},
    {"a segment tilted by a rounding meets a long plate where it does: the plane of contact is 13 u early",
     asking(
         Moving{Capsule<double>{V(-8, -8, -8), V(-0x1.fffffffffffcp+2, -0.8, 7), 0}, V(0x1.fffffffffffep+2, 4.4, 0.5)},
         at_rest(Obb<double>{V(0, 0, 0), V(0, 2, 1.6), Mat3<double>::Identity()})),
     {{hit}, 0x1.ffffffffffff9p-1, 0x1p-53}},
    {"a face that is met slowly is not met before the other faces are passed: its own plane's time is 2000 u early",
     asking(at_rest(Obb<double>{V(0, 0, 0), V(0x1.abcbf8e567a29p-5, 0x1.f5c72ae638499p+0, 0x1.3af30a1e46892p+0),
                                leaning(V(1, 0, 0), V(0, 0x1.fffffffff75ccp-1, -0x1.783084e24d2fcp-19),
                                        V(0, 0x1.783084e24d2fcp-19, 0x1.fffffffff75ccp-1))}),
            Moving{Aabb<double>{V(0, 0x1.f5d50712be9d5p+0, 0x1.28604bf9ff931p+6), V(0x1p-18, 0x1p-18, 0x1p-15)},
                   V(0, -0x1.cdb5ea5a3e862p-13, -0x1.3a32a1e20be1p+6)}),
     {{hit}, 0x1.daf0851021dc4p-1, 0x1p-53}},
    {"nor by a point",
     asking(at_rest(Obb<double>{V(0, 0, 0), V(0x1p-19, 0x1p-3, 0x1p-13),
                                leaning(V(1, 0, 0x1.fc1371ee75d2ep-35), V(0, 1, 0x1.fa249220099a7p-38),
                                        V(-0x1.fc1371ee75d2ep-35, -0x1.fa249220099a7p-38, 1))}),
            Moving{Sphere<double>{V(0x1.001a94ea1f359p-19, -0x1.ed14dd72176b5p+1, 0x1.7f5f1a93790fdp+1), 0},
                   V(-0x1.a26dfd515605p-30, 0x1.d55de44be4c3ap+2, -0x1.792c0fc9b32f8p+2)}),
     {{hit}, 0x1.04352e7049c71p-1, 0x1p-53}},
    {"nor by a sphere along it, by 1e-4 of the step",
     asking(at_rest(Obb<double>{V(0, 0, 0), V(0x1p-2, 0x1.2f0cdc8a4324cp-1, 0x1.1ca4b37ec6c47p+0),
                                leaning(V(0x1.6db291abf83d2p-1, -0x1.3e71c9bd6bb3fp-1, -0x1.48a5f5a9c4f2ep-2),
                                        V(0x1.3e71c9bd6bb3fp-1, 0x1.6a437a6a91109p-2, 0x1.65abb7f2a58dep-1),
                                        V(-0x1.48a5f5a9c4f2ep-2, -0x1.65abb7f2a58dep-1, 0x1.476f2b89504b3p-1))}),
            Moving{Sphere<double>{V(-0x1.20d172b7817cep+0, -0x1.e9b98fec41ac9p-1, -0x1.3248c648b747cp+1),
                                  0x1.3a6d9a4868daap-2},
                   V(0x1.286ecc939f29ep+1, 0x1.9a3e3e802b14ap-1, 0x1.ccf29b3ca44fbp+1)}),
     {{hit}, 0x1.fffffff01f1dfp-2, 1e-9}},
    {"a segment that slides into a triangle through its edge",
     asking(Moving{Capsule<double>{V(-0x1.4180332b6145ap+1, 0x1.d5d92948dec76p-2, -0x1.20484fae2906dp+3),
                                   V(-0x1.4180332b6145ap+1, 0x1.ac0c2d5a5346cp-3, -0x1.209421b04ba09p+3), 0},
                   V(0x1.2efb9f72294f8p+2, -0x1.42fb1f725dc81p-1, 0x1.107107857f017p+4)},
            at_rest(Triangle<double>{V(-0x1.28493b937f661p-3, -0x1.2f48088a66d54p-6, 0x1.ffa625376a48p-2),
                                     V(0x1.28493b937f661p-3, -0x1.2f48088a66d54p-6, 0x1.ffa625376a48p-2),
                                     V(-0x1.28493b937f661p-3, 0x1.2f48088a66d54p-6, -0x1.ffa625376a48p-2)})),
     {{hit}, 0x1.0000000000053p-1, 1e-15}},
    {"a small sphere that slides along a triangle's edge, past its corner",
     asking(at_rest(Triangle<double>{V(-0x1.fffffffe9027cp-3, -0x1.000000000b7ecp+0, -0x1.ddd326c34805ap-34),
                                     V(0x1.00000000b7ec2p-2, -0x1.ffffffffe9028p-1, -0x1.ddd326c34805ap-34),
                                     V(-0x1.00000000b7ec2p-2, 0x1.ffffffffe9028p-1, 0x1.ddd326c34805ap-34)}),
            Moving{Sphere<double>{V(0x1.e43ad47acd64cp-2, -0x1.00000fffea90ap+0, -0x1.dd7959aa7c02bp-34), 0x1p-20},
                   V(-0x1.44e3876463ebap+0, -0x1.c4cae32553325p-35, -0x1.fffffffcb9873p-42)}),
     {{hit}, 0x1.67c15bbcd44ep-3, 1e-9}},
    {"a capsule whose end slides along a triangle's edge, past its corner",
     asking(Moving{Capsule<double>{V(0x1.e7f1f8fdd4a12p+2, -0x1.01d83d22253afp-1, -0x1.d875e72871f5ep+1),
                                   V(0x1.e21d85db795b2p+2, -0x1.000fb730fe649p-1, -0x1.fdfff08cbd7fp-4), 0x1p-3},
                   V(-0x1.1c2daadda27b4p+5, 0x1.aa864d4441cfp-42, 0x1.aa864461757ecp-32)},
            at_rest(Triangle<double>{V(-0x1p-2, -0x1.fffff00000155p-2, 0x1.fffffaaaaaaefp-12),
                                     V(0x1p-2, -0x1.fffff00000155p-2, 0x1.fffffaaaaaaefp-12),
                                     V(-0x1.5937db80ee6aap-4, 0x1.fffff00000155p-2, -0x1.fffffaaaaaaefp-12)})),
     {{hit}, 0x1.bcdd595e8bbfp-3, 1e-6}},
    {"a sphere that comes along a segment, and within its radius just where that ends",
     asking(at_rest(Capsule<double>{V(-0x1.b341dc85d5c65p-1, 0, 0), V(0x1.b341dc85d5c65p-1, 0, 0), 0}),
            Moving{Sphere<double>{V(0x1.c50966ca71984p+4, 0x1.80ce2a0f61449p-3, -0x1.827cba6661daap-4),
                                  0x1.ae9a28371d161p-3},
                   V(-0x1.e3b5e313516ecp+5, 0x1.7310108de6984p-26, 0x1.71ba039c1e7b4p-25)}),
     {{hit}, 0x1.d122900c8fbccp-2, 1e-12}},
    {"a core does not come in between the faces of a prism whose sums are rounded apart",
     asking(Moving{Capsule<double>{V(0x1.280f7995cc932p-1, 0x1.dae1516b5ceeap-4, 0x1.8170a1b571cb2p-2),
                                   V(0x1.280f79b6ed9bp-1, 0x1.98110b47173eap-1, 0x1.8170a269a244cp-2), 0},
                   V(0x1.2a039be482667p-1, 0x1.5684b8e7896e5p-1, 0x1.0aad90d97a96fp-1)},
            Moving{Triangle<double>{V(0x1.d24b22e41739ap-2, 0x1.f1b8ad45be708p-5, 0x1.690a55d25b536p-2),
                                    V(0x1.b85b4d97675f2p-1, 0x1.dca28df36f52bp-2, -0x1.ab0913c2e189ep-5),
                                    V(0x1.096104818f244p-1, 0x1.54efeb6a5f8b2p-5, 0x1.6bfd6fb48da2p-2)},
                   V(0x1.2a039be482667p-1, 0x1.5684b8e7896e5p-1, 0x1.a3ff93bac1f24p-1)}),
     {{hit}, 0.30861411932178223, 1e-12}},
    {"nor in and out again, by two rims of the prism",
     asking(Moving{Capsule<double>{V(-0x1.bad0351525bd4p+1, -0x1.e208be829f932p+1, 0x1.64cf826f62952p+1),
                                   V(-0x1.07fd583b139cp+2, -0x1.d8de1016fab48p+1, 0x1.b9502cbc368c6p+1), 0},
                   V(0x1.2e6aaea4fe744p+2, 0x1.496ac3555440ap+2, -0x1.4c68ec2fbb277p+2)},
            at_rest(Triangle<double>{V(0x1.2e6974b96512p-2, 0x1.5562c5ec8c618p-2, -0x1.8666b7c669f64p-1),
                                     V(-0x1.7102c1bb6de1cp-2, 0x1.60bea0145435ep-1, -0x1.d8819f4898ebep-1),
                                     V(0x1.4c6fce09322dp-4, -0x1.90b6c4f4d6c7ep-1, -0x1.b75e9d5316c74p-1)})),
     {{hit}, 0.707498691090089, 1e-12}},
    {"nor at the start, with the end of the step within the prism",
     asking(Moving{Capsule<double>{V(0x1.fd65e446583ep-4, 0x1.63be3656fe7edp-1, 0x1.080ffcc601d76p+0),
                                   V(0x1.1fd65e446583ep+0, 0x1.c77c6cadfcfdap-2, 0x1.101ff98c03aedp-1), 0},
                   V(-0x1.6p-6, 0x1.cp-7, -0x1.2p-6)},
            at_rest(Triangle<double>{V(0x1.ep+0, 0x1.ep+0, -0x1.8p-1), V(0x1.6p+0, -0x1p+0, 0x1.6p+0),
                                     V(-0x1.8p-2, 0x1.8p-1, 0x1p+0)})),
     {{hit, overlapping}, 0, 1e-12}},
    {"a capsule that slides along a face that leans by 1e-10: by their normal the two ends are 2e-14 apart, which takes 1e-9 of the step",
     asking(
         Moving{Capsule<double>{V(-0x1.a8cb0441d7562p-13, 0, 0), V(0x1.a8cb0441d7562p-13, 0, 0), 0x1.559473bc96f62p-14},
                V(0x1.49492650d771fp-7, 0x1.a9f6cf8eb7441p-5, -0x1.a2967bb812648p-6)},
         Moving{Triangle<double>{V(-0x1.02159c07e9d83p-3, 0x1.56de7c315fa99p-14, -0x1.4abf2c273431cp-1),
                                 V(0x1.67d2eb8c05e1dp-6, 0x1.56de65350219p-14, 0x1.3ef0fe386281ap-2),
                                 V(-0x1.02159c06ce38bp-3, 0x1.56de90e2bd87p-14, -0x1.9a7b6bb547576p+0)},
                V(0x1.51ef179b14b1p-2, 0x1.a9bc3cf4a9adcp-5, -0x1.6926c68314174p-2)}),
     {{hit}, 0.011002985272795947, 1e-15}},
    {"a point that would meet a triangle a billionth of a rounding after the end",
     asking(at_rest(Triangle<double>{V(-0x1.a1a87813ab6a8p+13, -0x1.30e7c9bb1c733p+19, -0x1.d042c64b874ebp+18),
                                     V(0x1.2fa7228a94bf2p+13, 0x1.2a52db4f325e6p+18, -0x1.d8a59d9677f68p+18),
                                     V(0x1.c80556245aaep+11, 0x1.377cb8270688p+18, 0x1.d47431f0ffa28p+19)}),
            Moving{Sphere<double>{V(-0x1.49b1c31d67e17p+12, -0x1.5a25c6008d314p+19, -0x1.5240e276ebddfp+21), 0},
                   V(0x1.48ce021e6d4edp+13, 0x1.d95ef23762fcep+19, 0x1.738c85026c317p+21)}),
     {{apart}, 1, 0}},
    {"a sphere that moves along a segment, to rounding, 5e-4 of its radius off",
     asking(
         at_rest(Capsule<double>{V(0, 0, 0), V(0x1.741b4fbb6dfb2p-6, -0x1.7d11240db9fb4p-57, 0x1.7c5b4af46e875p-2), 2}),
         Moving{Sphere<double>{V(0x1.ff4b8ce7f3014p+1, 0, -0x1.f43483efc1b3dp-3), 2},
                V(0x1.f3f6052f1bd05p-14, 0, 0x1.ff0bab7284b0bp-10)}),
     {{apart}, 1, 0}},
    {"a sphere meets a needle by its edge: its plane is rounding, and 1e-7 early",
     asking(at_rest(Triangle<double>{V(0, 0, 0), V(-0x1.c83179e4de9ecp-5, 0x1.b5e27c9b9445cp-5, 0x1.9e11da81fp-17),
                                     V(-0x1.73f458faae5f4p-5, 0x1.6506d6a6620b9p-5, 0x1.519bfc110d228p-17)}),
            Moving{Sphere<double>{V(-0x1.3d1e4ed83e85bp-5, 0x1.37f749ef7b532p-5, -0x1.008a605439f82p+2), 4},
                   V(0x1.9bc076cf5e19p-28, -0x1.e3f1d7689de26p-17, 0x1.ffffff1b495f6p-5)}),
     {{hit}, 0x1.15098302c0d53p-3, 1e-14}},
    {"a segment without a radius is asked alike at every size",
     asking(Moving{Capsule<double>{V(2, 0.6, 2.8), V(-8, -0.8, -2), 0}, V(2, -7, 2)},
            at_rest(Triangle<double>{V(0, -2.5, 0), V(0, 0, 0),
                                     V(0x1.3333333333333p+0, -0x1.6666666666667p-1, 0x1.3333333333333p+2)})),
     {{hit}, 0x1.94a8e6a76437ep-4, 1e-16}},
    {"a long segment along an axis is not turned into a plate's axes, where each would be off by its length's rounding",
     asking(Moving{Capsule<double>{V(-0x1.978391500635p+3, -0x1.206995c89dcb1p+2, -0x1.fc272cd13c2a3p+23),
                                   V(-0x1.978391500635p+3, -0x1.206995c89dcb1p+2, 0x1.ec699761eae8p+16), 0},
                   V(0x1.60924e15a3953p+4, 0x1.6478b209b692fp+2, 0)},
            at_rest(Obb<double>{V::Zero(), V(0x1.e8efe7278a0ffp+1, 0x1p-8, 0x1.5d96a8507c4ap+0),
                                leaning(V(0x1.0622c0550184fp-4, 0x1.ba13222a4e629p-1, 0x1.00341ab1b075fp-1),
                                        V(0x1.5ccd5f847d05cp-1, 0x1.5080012885347p-2, -0x1.4eec1a7545a8ap-1),
                                        V(-0x1.755f768367637p-1, 0x1.87f2c0dcd4727p-2, -0x1.2265cee2e6071p-1))})),
     {{hit}, 0x1.0d134be6ff3fdp-1, 4e-16}},
    {"nor is one with a radius as long settled by a normal that leans along it",
     asking(Moving{Capsule<double>{V(-0x1.204135bef495ap+1, 0x1.90232153fe174p+21, 0x1.712b5fa44bba6p+0),
                                   V(-0x1.204135bef495ap+1, -0x1.37ee6f5600f46p+22, 0x1.712b5fa44bba6p+0), 0.125},
                   V(0x1.b56bc518f8f14p+0, 0, -0x1.0e75be78e46c2p-2)},
            at_rest(Obb<double>{V::Zero(), V(0x1.54e89bd1d2fbcp-2, 0x1p-10, 0x1.a9efcc96b5f27p+1),
                                leaning(V(-0x1.0da108ac4d5f9p-1, -0x1.b0020862aed7ep-1, 0x1.a853739f136aep-4),
                                        V(-0x1.024d1760ebaedp-1, 0x1.b26735ef81887p-3, -0x1.ac856b2b7119ap-1),
                                        V(0x1.5e5223c2ca477p-1, -0x1.f8da3c55aa639p-2, -0x1.132308eb81b29p-1))})),
     {{hit}, 0x1.e0c8949652ac7p-5, 1e-15}},
    {"a ball beside the edge of a long box is met across it, not along what rounding leans its normal",
     asking(Moving{Obb<double>{V(0x1.f118884b0e2a2p+3, -0x1.445efe5cb65bfp+10, -0x1.dfa7af119b601p+10),
                               V(0x1.6091474c4d3bap+11, 0x1.0d7bb40d5bf2ap+0, 0x1.5eea450434174p-2),
                               leaning(V(0x1.691c150759aa1p-7, -0x1.1ed2f8950923dp-1, -0x1.a8148e3403bb4p-1),
                                       V(-0x1.c8a1db7461c19p-2, -0x1.7d01f67a955fcp-1, 0x1.fd4f17d1fa6eap-2),
                                       V(-0x1.ca3d718634e78p-1, 0x1.749b8614137e5p-2, -0x1.083457ecae93cp-2))},
                   V(0x1.12f85a0563eecp+3, 0, 0)},
            at_rest(Sphere<double>{V(-0x1.29271540b735p+0, -0x1.3d894e6b640ap+0, -0x1.aca21c2fa68f3p+1),
                                   0x1.8bc63d14a68fap+0})),
     {{hit}, 0x1.81a6b22bd6627p-1, 8e-15}},
    {"a capsule of a hundred lengths meets an edge where the edge is given, not where its core's rounding puts it",
     asking(Moving{Capsule<double>{V(0x1.cff2e6efd0389p+7, -0x1.b6d8104b8b4ep+1, -0x1.3c25eb94461f5p+1),
                                   V(-0x1.8068c8817e3b8p+4, -0x1.b6d8104b8b4ep+1, -0x1.3c25eb94461f5p+1), 0.125},
                   V(0x1.d4adcf0bae66dp+3, 0x1.5099fc350a885p+2, 0x1.dbf6ff208f04bp+1)},
            at_rest(Obb<double>{V::Zero(), V(0x1.b2544a3319dfbp-4, 0, 0x1.6f4758a6abc7cp-1),
                                leaning(V(-0x1.3a8c9415413a4p-1, -0x1.4513f1bee984ep-1, -0x1.dfb2515e4f677p-2),
                                        V(0x1.2e83e6c75da1ap-1, 0x1.7daf017fb9bb8p-6, -0x1.9ce65a9ddebep-1),
                                        V(0x1.0bbeb6a7923b4p-1, -0x1.8b6185267e4a5p-1, 0x1.717d336e5dfb2p-2))})),
     {{hit}, 0x1.3f6733d5f8ed1p-1, 3e-16}},
    {"a long box is not met where its plane's rounding has it, before a short one's that is met at the same time",
     asking(Moving{Obb<double>{V(0x1.eccccccccccccp+0, 0x1.1605cece556f2p+7, 0x1.f47d99f453723p+8),
                               V(0x1.6666666666666p-1, 0x1.6666666666666p-2, 0x1.6p+2),
                               leaning(V(1, 0, 0), V(0, -0x1.0907dc193068ep-2, 0x1.ee8dd4748bf15p-1),
                                       V(0, -0x1.ee8dd4748bf15p-1, -0x1.0907dc193068ep-2))},
                   V(-0x1.6666666666666p+0, -0x1.730b00f01092dp-3, -0x1.5a3014b7fb8f5p-1)},
            at_rest(Obb<double>{V(0, 0, 0), V(0x1.6666666666666p-1, 0x1.020cccccccccdp+9, 0x1.999999999999ap-3),
                                leaning(V(1, 0, 0), V(0, -0x1.0907dc193068ep-2, -0x1.ee8dd4748bf15p-1),
                                        V(0, 0x1.ee8dd4748bf15p-1, -0x1.0907dc193068ep-2))})),
     {{hit}, 0x1.7ffffffffffffp-2, 2e-16}},
    {"nor is it met at all where the short one's plane is reached after the step",
     asking(Moving{Obb<double>{V(0x1.999999999999ap-4, 0x1.00000000000c2p+1, -0x1.5fcp+9),
                               V(0x1.999999999999ap-3, 0x1.999999999999ap-4, 0x1.5f8p+9),
                               leaning(V(1, 0, 0), V(0, -1, 0x1.1a62633145c07p-53), V(0, -0x1.1a62633145c07p-53, -1))},
                   V(0, -1.5, 0x1.999999999999ap-4)},
            at_rest(Obb<double>{V(0, 0, 0), V(0x1.999999999999ap+0, 0x1.999999999999ap-2, 0x1.999999999999ap-2),
                                Mat3<double>::Identity()})),
     {{apart}, 1, 0}},
    {"a core that leans by 2^-50 is met after the step by what of it is beside the box",
     asking(
         Moving{Capsule<double>{V(16.25, 0x1.0000000000008p+0, 4.875), V(16.25, 1, -4.125), 0.25}, V(0, -0.25, -0.25)},
         at_rest(Obb<double>{V(0, 0, 0), V(16.5, 0.5, 0.25), Mat3<double>::Identity()})),
     {{apart}, 1, 0}},
    {"and by a core that it crosses",
     asking(Moving{Capsule<double>{V(610.25, 1208, 1208), V(0x1.3120000000002p+9, 1208, 0), 6}, V(-604, -1208, 0)},
            at_rest(Capsule<double>{V(0, -0.25, 0), V(0, 0.25, 0), 0.25})),
     {{apart}, 1, 0}},
    {"a core all but level with a triangle's face is met by the face",
     asking(Moving{Capsule<double>{V(-0x1.300000000008dp+1, -92, -93.25), V(-0x1.300000000008dp+1, 94.5, -93.25), 1.5},
                   V(3.5, 0, 0)},
            at_rest(Triangle<double>{V(0x1.1a1bca98796fp-45, 170.5, -93.25), V(0x1.1a1bca98796fp-45, 170.5, 186.5),
                                     V(-0x1.1a1bca98796fp-44, -341, -93.25)})),
     {{hit}, 0x1.00000000000ebp-2, 5e-16}},
    {"a long core across the coordinates is met across them: what rounds along it moves all of it alike",
     asking(Moving{Sphere<double>{V(0x1.3333333333334p-5, -0x1.b333333333334p-2, -0x1.0ccccccccccccp-2),
                                  0x1.999999999999ap-3},
                   V(-0x1.999999999999ap-4, 0x1.999999999999ap-3, 0x1.6666666666666p-1)},
            at_rest(Capsule<double>{V(0x1.4818f8ce34e34p+6, 0, -0x1.4818f8ce34e2ep+6),
                                    V(-0x1.4818f8ce34e34p+6, 0, 0x1.4818f8ce34e2ep+6), 0.15})),
     {{hit}, 0x1.8p-2, 1e-15}},
    {"and so is a long triangle",
     asking(Moving{Sphere<double>{V(-0x1.2cf1d45335ce8p+0, -2.8125, 0x1.57efce15f4584p-3), 0x1.e666666666666p+0},
                   V(-0x1.57efce15f45ap-1, 8, 0x1.57efce15f4598p-1)},
            Moving{Triangle<double>{V(0x1.cf03761158518p+8, -0x1.999999999999ap-3, -0x1.cf0376115850fp+8),
                                    V(-0x1.cf03761158518p+9, -0x1.999999999999ap-3, 0x1.cf0376115850fp+9),
                                    V(0x1.cf03761158518p+8, 0x1.999999999999ap-2, -0x1.cf0376115850fp+8)},
                   V(-0x1.01f3da9077434p+1, 0x1.8666666666666p+2, -0x1.57efce15f45a6p-1)}),
     {{hit}, 0x1.7ffffffffffffp-2, 1e-15}},
    {"a needle meets a long face where its edges have it, from which its axis leans by a rounding of all its length",
     asking(at_rest(Obb<double>{V(-0x1.697731bb01206p-6, 0x1.9bb848a3e3e8p-11, 0x1.21d0e87fd420cp-5),
                                V(0x1p-3, 0x1p-7, 0x1.e8f102f1381d2p-6),
                                leaning(V(1, 0, 0), V(0, -0x1.ffffffffffffcp-2, 0x1.bb67ae8584cabp-1),
                                        V(0, -0x1.bb67ae8584cabp-1, -0x1.ffffffffffffcp-2))}),
            Moving{Obb<double>{V(0x1.218ec3092dde7p-2, -0x1.03e4f82e17d5ep-3, -0x1.63916547586ccp-4),
                               V(0x1.03a702df2e7c5p-7, 0x1p-3, 0x1.7a0294f8bd312p+0),
                               leaning(V(0x1.782b607a3b96p-5, 0x1.ff75344d330e4p-1, 0x1.76952c485ee8p-9),
                                       V(-0x1.0c2ee6bf25bfcp-4, 0x1.4506cf0c67p-13, 0x1.fee6c01dc9d6bp-1),
                                       V(0x1.fe5c31cc6f2c4p-1, -0x1.78e526870a9dp-5, 0x1.0beda9ccff0ap-4))},
                   V(-0x1.bb3edfa701d1cp-2, 0x1.7376d14500b3dp-3, 0x1.612999981a229p-3)}),
     {{hit}, 0.435694407704359611831176, 1e-15}},
    {"and so does a segment without a radius",
     asking(at_rest(Capsule<double>{V(-0x1.a450df12f6a2ep-5, 0x1.99d519743323ep-6, -0x1.a36a4e8b86718p-7),
                                    V(0x1.461ee7972059ep-5, -0x1.17ab61c754245p-5, 0x1.91b03ff224bdp-5), 0}),
            Moving{Obb<double>{V(0x1.5b1f3090642cdp-5, 0x1.1d19be5c12936p-4, 0x1.36f393bddcb79p-6),
                               V(1, 0x1.e4eb1ceaa4d18p-3, 0x1p-7),
                               leaning(V(-0x1.5b9f323679cp-9, 0x1.e7a3c9bfcb675p-1, 0x1.38164a00f6c18p-2),
                                       V(0x1.0b0918ea57912p-2, -0x1.2c9d728252908p-2, 0x1.d6e060ce5f82cp-1),
                                       V(0x1.ee48500e41686p-1, 0x1.4f87f22b20fdp-4, -0x1.fb10f347e6d28p-3))},
                   V(-0x1.1481cc2e684fcp-4, -0x1.aee2ba2d5efe4p-4, -0x1.42ae4bedb9362p-10)}),
     {{hit}, 0.1442803953606102411295765, 2e-15}},
    {"a point within a triangle's plane comes in by its edge",
     asking(Moving{Sphere<double>{V(0x1.12ec515d56b03p+3, 0x1.b566666666667p+7, -0x1.12ec515d56b02p+3), 0},
                   V(-0x1.12ec515d56b03p+6, -0x1.84ccccccccccdp+7, 0x1.12ec515d56b02p+6)},
            at_rest(Triangle<double>{V(-0x1.12ec515d56b03p+6, -0x1.84ccccccccccdp+6, 0x1.12ec515d56b02p+6),
                                     V(0x1.12ec515d56b03p+7, -0x1.84ccccccccccdp+6, -0x1.12ec515d56b02p+7),
                                     V(-0x1.12ec515d56b03p+6, 0x1.84ccccccccccdp+7, 0x1.12ec515d56b02p+6)})),
     {{hit}, 0x1.d555555555556p-2, 1e-15}},
    {"a path all but along an edge, 2000 long, is as exact as from its near end, whatever rounding leans it along it",
     asking(Moving{Triangle<double>{V(1, 1.5, 0), V(-0x1.e1e2eddd8f344p+1, 0x1.cc6e94031330dp+3, -0x1.da44819e727b5p+2),
                                    V(0x1.2d4834152976dp+10, 0x1.2c4e1bceb3cfcp+10, 0x1.f160cb3880c93p+9)},
                   V(-0x1.390a8e54af9ep+9, -0x1.38cd4a9911109p+9, -0x1.026b1ab2a7953p+9)},
            Moving{Sphere<double>{V(2, -0x1.49360b3f3048p-6, 0.5), 0x1.b89ae44eb60eap-2},
                   V(-0.5, 0x1.94bcf89514dacp-1, 0)}),
     {{hit}, 0.61681880432348168, 2e-13}},
    {"a path all but along a capsule is as exact from afar",
     asking(Moving{Sphere<double>{V(0x1.8f1d85f029048p+3, -0x1.f2e39bfb3248dp+3, -0x1.8736ab8e906aep+2),
                                  0x1.fe2cbd1ba3735p-4},
                   V(-0x1.1e43ab7bda3aap+4, 0x1.68b68f6c31f25p+4, 0x1.1f24bcf8188bap+3)},
            at_rest(Capsule<double>{V(0x1.012e93d07d97p-2, -0x1.5b8132e226082p-2, -0x1.fc23dc7c7eff1p-4),
                                    V(-0x1.012e93d07d97p-2, 0x1.5b8132e226082p-2, 0x1.fc23dc7c7eff1p-4),
                                    0x1.a1d60ba99cb64p-8})),
     {{hit}, 0.7036581263548225, 1.2e-13}},
    {"what is turned into a box's axes and back is off by roundings that this time cannot take",
     asking(
         Moving{Obb<double>{V(-0.042281286622470465, 0.63528132074776966, 0.72097587403252039),
                            V(1.7619132786628439e-05, 8.6217030662366504e-05, 8.0554509881053477e-05),
                            leaning(V(-0.90335260763482883, 0.21136455212866964, 0.37320114199021687),
                                    V(0.42181729703835347, 0.59529408970028752, 0.68388238366488385),
                                    V(-0.077615940364158698, 0.77520963156513534, -0.62691769230899397))},
                V(0.16824420978678942, -1.2252627161463991, -2.1868650498364945)},
         at_rest(Obb<double>{V(0, 0, 0), V(5.4432878938553661e-06, 0.68037702524704569, 0.62104284047673619),
                             leaning(V(1, 6.6146931530346441e-11, 0), V(-6.6146931530346441e-11, 1, 0), V(0, 0, 1))})),
     {{hit}, 0.25092873584165976, 4 * 0x1p-53 * 0.502618}},
    {"nor can another, of two boxes as well",
     asking(
         Moving{Obb<double>{V(-0.097724368470831546, -0.6008172648504293, -0.83156201607235347),
                            V(0.00034100482401615436, 0.017333205910582471, 0.031939004449829882),
                            leaning(V(0.39228574955973139, 0.86867224365819007, 0.30252342684527),
                                    V(-0.7142297063752604, 0.49490204316592334, -0.49492210922659713),
                                    V(-0.57964456110919282, -0.021920327735695855, 0.8145745404863145))},
                V(0.082207652030352615, 1.4712928034225632, 2.0319351968345694)},
         at_rest(Obb<double>{V(0, 0, 0), V(0.022465097933876334, 0.18324166694040162, 0.95118909253578354),
                             leaning(V(1, 1.3481842710807832e-12, 0), V(-1.3481842710807832e-12, 1, 0), V(0, 0, 1))})),
     {{hit}, 0.53805621893617217, 4 * 0x1p-53 * 2.3775}},
    {"nor one of a capsule at a small box",
     asking(Moving{Capsule<double>{V(-0.00044232263031474591, -0.043765943061762583, 0.048470378983869619),
                                   V(-0.0015210047378717618, -0.018489365065875174, -0.011765075135658245),
                                   0.0013607007263624459},
                   V(-0.0010637951015928227, 0.056404940057816703, -0.03732145226632029)},
            at_rest(Obb<double>{V(0, 0, 0), V(0.00022549653042836228, 0.00012094079750388211, 3.7586386786801103e-05),
                                leaning(V(0.30497327415969216, 0.047025952046253927, 0.95119917045930014),
                                        V(0.71193830225021426, 0.6521368255145702, -0.26050223530108435),
                                        V(-0.63256237308063124, 0.75664134214429646, 0.16540472641577633))})),
     {{hit}, 0.57151867268931411, 4 * 0x1p-53 * 72827.6}},
    {"nor one of a capsule at a box of next to no size, which a rounding of the inputs moves by millions of its own",
     asking(Moving{Capsule<double>{V(0.21665118967423205, -1.2792993441504388, 0.23594155810300277),
                                   V(-0.53936932567446072, -0.35257719919996228, -0.30205762885929599),
                                   0.0045114042380326805},
                   V(0.16766401904958964, 0.82252473994796893, 0.028874811928180769)},
            Moving{Obb<double>{V(0, 0, 0), V(1.8602514130471267e-07, 9.6850347178746714e-08, 2.4764272905278112e-07),
                               leaning(V(-0.20881584105655338, -0.46335911241932537, 0.86121674244165691),
                                       V(0.83659329729937904, -0.54069953879474852, -0.088066245865820764),
                                       V(0.5064657929590084, 0.70209852704953124, 0.50054975664491297))},
                   V(0.0029009674599223103, -0.0022016632116509502, -0.00020204726862141237)}),
     {{hit}, 0.98983947024062635, 4 * 0x1p-53 * 3.81734e+06}},
};

TEST(HardQueries, motions_have_the_answers_of_the_table) {
  for (const Finding& finding : findings) {
    SCOPED_TRACE(finding.about);
    const Toi<double> toi = finding.ask(false, 0);
    const auto& [may_be, time, within] = finding.truth;
    EXPECT_NE(std::ranges::find(may_be, toi.status), may_be.end()) << static_cast<int>(toi.status);
    EXPECT_NEAR(toi.time, time, within);
    EXPECT_TRUE(testing::same_answer(finding.ask(true, 0), toi));
    for (const int scale : {-6, -3, 3, 6}) EXPECT_TRUE(testing::same_answer(finding.ask(false, scale), toi)) << scale;
  }
}

// ---- Other queries, and what more there is to say of a motion.

// So near to another part of the core that its plane or its cylinder is as far, to the square of how far beside: the normal shows it.
TEST(HardQueries, a_flat_core_is_left_where_it_is_nearest) {
  const Capsule<double> rod{V(0, 0, 0), V(-0x1.4adb75df6c3cap-1, -0x1.8b8fca140ef8fp-5, -0x1.8b8fca140ef8ep-5),
                            0x1.be1e1f76f753ep-1};
  const Capsule<double> other{V(-0x1.13fca8d03d688p-1, 0x1.04c37e2576292p-1, 0x1.1f0d7a6d201a1p+2),
                              V(-0x1.2598691b4607p-3, -0x1.3c778dd256f24p-2, 0x1.224aad21526b8p+2), 0};
  const auto crossed =
      time_of_impact(Moving{rod, V(-0x1.5dffb4a5d04ep-4, -0x1.e88a4acc5fbc8p-6, 0x1.c06281d1a7e4p-5)},
                     Moving{other, V(0x1.db101286a254p-2, -0x1.7ee62b59e72ecp-3, -0x1.ceac01d4e518ep+2)});
  EXPECT_NEAR(crossed.normal[0], -0.07633044895, 1e-10);
  const Triangle<double> needle{V(0, 0, 0), V(0x1.e9c4080f96721p-1, 0x1.e9c4080f9671fp-1, -0x1.e9c4080f9671fp-58),
                                V(0x1.8efa68011c6ecp-1, 0x1.8efa6801199a8p-1, -0x1.8efa6801199a8p-58)};
  const Sphere<double> ball{V(0x1.c3c4780484e8bp-8, 0x1.be1c506ae51a9p-8, 0x1.000000000000cp+1), 1};
  const auto below =
      time_of_impact(at_rest(needle), Moving{ball, V(-0x1.6a09e667f3bccp-14, 0x1.6a09e667f37cdp-14, -2)});
  EXPECT_NEAR(below.normal[0], 0, 1e-12);
  EXPECT_NEAR(below.normal[1], 0, 1e-12);
}

// It closes so slowly that another edge's roundings reach it 4e-4 of its time later.
TEST(HardQueries, a_graze_between_two_edges_is_in_doubt) {
  const F corner(-0x1.f82c28p-4F, 0x1.0d7e5cp-2F, -0x1.d4967p-5F), end(-0x1.82912p+1F, 0x1.3614ap-3F, -0x1.5ec962p-3F);
  const F rod = F(-0x1.89488ap+1F, -0x1.3f81e8p-3F, -0x1.346d54p-2F) - end;
  const F edge1 = F(0x1.68ff46p-3F, -0x1.4f03f8p-1F, 0x1.5fa308p-2F) - corner;
  const F edge2 = F(0x1.6b655p-5F, -0x1.43e582p-5F, -0x1.1f36cap-2F) - corner;
  const auto entry = capsule_triangle_entry<float>(end - corner, F(0x1.65cbdp+2F, -0x1.4f0f78p-2F, -0x1.e3ccaap-3F),
                                                   0x1.7c52acp-6F, rod, edge1, edge2);
  EXPECT_TRUE(entry.graze || std::abs(entry.time - 0.5480246F) < 1e-6F) << entry.time;
}

// A step by a plane that hardly closes goes 600 past the graze: the doubt is where the way was nearest.
TEST(HardQueries, a_graze_that_the_walk_steps_far_past_is_in_doubt) {
  const Moving wall{Obb<double>{V(0x1.12d0419249b0cp+6, -0x1.6666666666667p-2, -0x1.0b3b45161f5b5p+7),
                                V(0x1.999999999999ap-4, 0x1.08p+5, 0x1.999999999999ap-5), Mat3<double>::Identity()},
                    V(0, 0x1.999999999999ap-2, 0x1.b733333333333p+5)};
  const Obb<double> plank{V(0, 0, 0), V(0x1.b533333333333p+6, 0x1.999999999999ap-4, 0x1.3333333333333p-2),
                          leaning(V(0x1.3ffc0015f038dp-1, 0x1.a2911543da048p-6, -0x1.8f7a71722dabap-1),
                                  V(-0x1.4d82e980d2855p-1, -0x1.1149fd8a899d3p-1, -0x1.1417c6231230dp-1),
                                  V(-0x1.b89062d8aa114p-2, 0x1.b0c3fac17fcb8p-1, -0x1.448dd1bbab7cfp-2))};
  const auto toi = time_of_impact(ClosedForm<double>{0x1.999999999999ap-4}, wall, at_rest(plank));
  EXPECT_EQ(toi.status, hit);
  EXPECT_NEAR(toi.time, 0.88225, 1e-6);
}

// A radius below the roundings of the way does not tell a face's sides apart, the motion does.
TEST(HardQueries, a_hardly_rounded_triangle_is_met_against_the_motion) {
  const auto rod = at_rest(Capsule<double>{V(0, 0, 0), V(0.375, 0.125, -0.125), 0x1p-64});
  const Triangle<double> triangle{V(0x1.19481cf40ba71p+0, -0x1.4fc4366eb502ep+1, 0x1.5a245899ca9d2p-2),
                                  V(0x1.9481cf40ba71p-4, -0x1.3f10d9bad40b8p-1, -0x1.52edd3b31ab16p-1),
                                  V(0x1.19481cf40ba71p+0, -0x1.4fc4366eb502ep+1, -0x1.52edd3b31ab17p-1)};
  const V along(-0x1.a420fa3b04d9cp-3, 0x1.0d96a842251f6p+1, 0x1.7d80f2ae286eep+0);
  const auto toi = time_of_impact(rod, Moving{triangle, along});
  EXPECT_EQ(toi.status, hit);
  EXPECT_NEAR(toi.normal.dot(along) / along.norm(), -0.887, 1e-3);
}

// A rod of 2700 gap widths slides by: what its normal leaned along it by rounding, its length took off the gap.
TEST(HardQueries, a_long_box_within_a_gap_is_met_along_a_normal_that_does_not_lean) {
  const Moving small{Obb<double>{V(0x1.8bb7302ab81d2p+0, -1, -1.5),
                                 V(0x1.d715b08607b37p-36, 0x1.1714dd882e6b6p-11, 0x1.bfa79137327bap-10),
                                 leaning(V(-1, 0, 0), V(0, 1, 0), V(0, 0, -1))},
                     V(0x1.64807532db27dp+10, 0x1.b20b8329c5134p+1, 0x1.75cd72334cf98p+2)};
  const V x(0x1.ffffffffffff2p-1, 0x1.e478d3e3c495cp-25, -0x1.97f3b5ae3bd57p-29),
      y(-0x1.e478d3df14156p-25, 0x1.ffffffffffff1p-1, 0x1.78ac18b04852p-27),
      z(0x1.97f3bb3fea22fp-29, -0x1.78ac184fc7276p-27, 0x1.fffffffffffffp-1);
  const Moving rod{Obb<double>{V(0, 0x1.9d5f7ade2a778p+0, 2),
                               V(0x1.56516239fe9cap+10, 0x1.4a20f87fcfe36p-8, 0x1.d420cda2a8017p-13), leaning(x, y, z)},
                   V(0, -1, -0x1.4c9dbecc8ed8cp-5)};
  const auto toi = time_of_impact(ClosedForm<double>{0x1.4b0d3962c7ebdp-7}, small, rod);
  EXPECT_NEAR(toi.time, 0.59323096091163507, 1e-15);
}

// The normal is across a rod's length but for the rounding of a turn, which its 3000 gap widths multiplied.
TEST(HardQueries, a_long_box_within_a_gap_is_met_across_its_length) {
  const Moving plate{Obb<double>{V(-0x1.e613456215b5cp+9, 0x1.eea3c6437048ep-3, 0x1.d458eaa24eedbp+0),
                                 V(0, 0x1.60e9b270e3bccp+1, 0x1.0d704bb34d66cp-4),
                                 leaning(V(-0x1.13ab3be746ed2p-1, -0x1.af5ab48bac5dap-1, 0x1.257e7d387d974p-6),
                                         V(0x1.248896f2a34c7p-2, -0x1.9eb12cb49357cp-3, -0x1.df95cda678ffap-1),
                                         V(0x1.95e6febe7ebdp-1, -0x1.ff3131b6a8a0fp-2, 0x1.66183b55affd1p-2))},
                     V(-0x1.e4cacdcd9fce6p-2, -0x1.0b1449a477233p-2, -0x1.da017f6b91ab1p-7)};
  const double c = 0x1.6a09e667f3bccp-1, s = 0x1.6a09e667f3bcdp-1;
  const Obb<double> rod{V(-0x1.357f9f3dac0a4p-3, -0x1.601d7e6c18b8ep-2, 0x1.d2f5e54806058p-3),
                        V(0x1.a5a8a5e0853dp+11, 0x1.cbafe0d1216c7p-3, 0x1.59760a23a1354p-11),
                        leaning(V(1, 0, 0), V(0, -c, s), V(0, -s, -c))};
  const auto toi = time_of_impact(ClosedForm<double>{0x1.beed2619df85bp-8}, plate, at_rest(rod));
  EXPECT_NEAR(toi.time, 0x1.01c0ab97d2c8cp-8, 1e-15);
}

// Apart at the start by a rounding or two of their sizes, at 50 digits: what is turned into a box's axes is off by as much.
TEST(HardQueries, what_is_apart_by_a_rounding_of_what_is_turned_does_not_overlap) {
  const auto are_apart = [](const auto& a, const auto& b) {
    return !overlaps(a, b) && !overlaps(b, a) && !contact(a, b) &&
           time_of_impact(at_rest(a), at_rest(b)).status == ToiStatus::apart;
  };
  Mat3<double> pitched, turned;
  pitched << 1, 0, 0, 0, 0.50000000000000011, -0.8660254037844386, 0, 0.8660254037844386, 0.50000000000000011;
  turned << -0.70710678118654791, 0.70710678118654713, 0, -0.70710678118654713, -0.70710678118654791, 0, 0, 0, 1;
  EXPECT_TRUE(are_apart(Aabb<double>{V(0, -260.80121467478062, 0), V(71, 0.1, 284)},
                        Obb<double>{V::Zero(), V(3, 29.5, 284), pitched}));
  EXPECT_TRUE(are_apart(Capsule<double>{V(20.9, 3.248528137423857, 0.55), V(-25.7, 3.2485281374238597, 0.55), 2.4},
                        Obb<double>{V::Zero(), V(0.7, 0.5, 4.8), turned}));
}

TEST(HardQueries, edges_that_are_all_but_parallel_meet_at_a_point_of_both) {  // one of them 1300 long
  Mat3<double> axes;
  axes.col(0) << -0.24835351637513869, 0.94523302415796362, -0.21179013420198473;
  axes.col(1) << 0.95592948774035924, 0.27450085901331689, 0.10415417835788246;
  axes.col(2) << 0.15658654275689965, -0.17658937805582173, -0.97174937416254625;
  const Moving rod{Aabb<double>{V(-22.133252183286928, -1.9424433218296717, 1646.5425785702751), V(9.4, 1.6, 659.6)},
                   V(12.1, -2.2397138587058771, 9.1314665761377469)};
  const auto box = at_rest(Obb<double>{V(0, 0, 1000), V(0.9, 6.8, 9.4), axes});
  const auto toi = time_of_impact(rod, box);
  ASSERT_EQ(toi.status, ToiStatus::hit);
  const Sphere<double> there{toi.point, 0};
  EXPECT_NEAR(separation(pose_at(rod, toi.time), there).distance, 0, 1e-13);
  EXPECT_NEAR(separation(box.shape, there).distance, 0, 1e-13);
}

TEST(HardQueries, what_is_asked_wider_is_answered_of_the_edges_given) {  // one 979 long, which leans by roundings
  const Moving plate{
      Obb<double>{V(-40.982985201705276, 489.83745987050469, 0.5), V(26.75, 1, 0.25), Mat3<double>::Identity()},
      V(242.84308088782774, -140.20551812142537, -0.5)};
  const auto rod = at_rest(Obb<double>{V(0, 0, 0), V(0.25, 0.5, 489.5),
                                       leaning(V(-0.43739825234106888, -0.0095642513993939859, -0.89921704495863919),
                                               V(-0.89892055550320449, -0.023139810642283987, 0.43750015320825802),
                                               V(-0.024992073599214459, 0.99968648798441206, 0.0015238105535230195))});
  const auto toi = time_of_impact(ClosedForm<double>{0.5}, plate, rod);
  ASSERT_EQ(toi.status, ToiStatus::hit);
  EXPECT_NEAR(toi.time, 0.0038730991659893443044, 4 * 0x1p-53 * 0.337526);
}

// A quaternion's axes are off right angles by roundings, which count by all of a wall's length: its face is where its edges are.
TEST(HardQueries, a_wall_whose_axes_come_from_a_quaternion_is_met_where_its_edges_are) {
  testing::Shaker<double> draw(61);
  const auto ask = [&](const auto& shape, double reach) {
    const Mat3<double> axes = draw.quaternion_axes();
    const Obb<double> wall{V::Zero(), {1000, 1000, 1}, axes};
    const V above = axes * V(draw.plain() * 999, draw.plain() * 999, 2 + reach);
    const auto shot = Moving{moved<double>(shape, above), V(axes * V(draw.plain(), draw.plain(), -2))};
    const Vec3<long double> normal =
        accurate_cross<long double>(axes.col(0).cast<long double>(), axes.col(1).cast<long double>());
    const long double up = normal.dot(axes.col(2).cast<long double>()), length = std::sqrt(normal.dot(normal));
    const long double height = normal.dot(above.cast<long double>()) - up - length * reach;
    const long double closing = -normal.dot(shot.displacement.template cast<long double>());
    const double size = normal.cast<double>().cwiseAbs().dot(above.cwiseAbs() + half_widths(wall)) + reach;
    for (const auto& toi :
         {time_of_impact(shot, at_rest(wall)), careful_impact(ClosedForm<double>{}, at_rest(wall), shot)})
      EXPECT_NEAR(static_cast<double>((toi.time - height / closing) * closing), 0, 4 * 0x1p-53 * size);
  };
  for (int i = 0; i < 20'000; ++i) {
    ask(Sphere<double>{V::Zero(), 0.25}, 0.25);
    ask(Sphere<double>{V::Zero(), 0}, 0);
  }
}

// The plate is 4e4 times as wide as it is thick, and upright but for 2^-49: a normal turned into the other box's axes and back tilts it by
// more than what its gap is known to.
TEST(HardQueries, a_plate_within_a_gap_is_met_along_its_own_normal) {
  const Moving chip{Obb<double>{V(0x1.b459aa4d227a4p-6, 0x1.1b4631dcddaf8p-6, -0x1.d68639e18b07ep-1),
                                V(0x1.71fea3ad5c0b9p-16, 0x1.885dcf5aea50cp-7, 0x1.ef240121f0ad5p-7),
                                leaning(V(-0x1.22c84449ea0eep-1, -0x1.a1b36176ee6cfp-1, 0x1.be8da51f09f2cp-4),
                                        V(-0x1.86bb45cd561e3p-1, 0x1.24a39a02b1b34p-1, 0x1.34c5f99e2cc07p-2),
                                        V(-0x1.3bb649f101c4bp-2, 0x1.68aa69383daebp-4, -0x1.e4f78c5f8b06ep-1))},
                    V(-0x1.134dbd58257eap-6, -0x1.66135d5976d54p-7, 0x1.08becc333f487p+1)};
  const Obb<double> plate{V::Zero(), V(0x1.63c9dee668e09p-16, 0x1.cb205bf358838p-3, 0x1.ce68adc74dec5p-1),
                          leaning(V(1, 0x1.028030ceae54p-49, 0), V(-0x1.028030ceae54p-49, 1, 0), V(0, 0, 1))};
  const auto toi = time_of_impact(ClosedForm<double>{0x1.37c5c26152b47p-9}, chip, at_rest(plate));
  EXPECT_NEAR(toi.time, 0.62033409617016189, 1e-15);
}

// The chip's own face is 2^-54 from the plate's: along that the plate would be met where it leans to.
TEST(HardQueries, a_chip_within_a_gap_is_met_along_the_plates_normal_and_not_its_own) {
  const double r = 0x1.9bbb75b826ed5p-56, s = 0x1.a19adc6608707p-54;
  const Moving chip{
      Obb<double>{V(0x1.002p-5, -0x1.76e8964a54a1dp-7, -0x1.82cd0c38800b8p-4),
                  V(0x1p-16, 0x1.301062152a906p-3, 0x1.ace4a26f15636p-3), leaning(V(1, 0, 0), V(0, 1, r), V(0, -r, 1))},
      V(-0x1p-4, 0x1.44613d13bebf6p-7, -0x1.a0c70e7722527p-9)};
  const Obb<double> plate{V::Zero(), V(0x1.c15e79281c1ffp-20, 0x1.d88396e5710dbp-2, 0x1.5a310d688f84bp-1),
                          leaning(V(1, s, 0), V(-s, 1, 0), V(0, 0, 1))};
  const auto toi = time_of_impact(ClosedForm<double>{0x1.eaa2cbec8b764p-15}, chip, at_rest(plate));
  EXPECT_NEAR(toi.time, 0.49903740175911931, 1.2e-16);
}

// A gap that counts as contact is asked of the larger box in its own axes: in a small one's its face would lean by a rounding of all its length.
TEST(HardQueries, the_gap_above_a_large_box_is_its_own) {
  const Obb<double> stone{V(-0x1.1fffffffffffep+0, 0.25, -0x1.681cb1a1c62c8p+2), V(2.25, 4.5, 1.125),
                          leaning(V(0x1.171e57d4f3846p-1, 0x1.141f5094733e1p-1, -0x1.489f944124213p-1),
                                  V(0x1.7bb69195192aep-1, 0x1.7eeb5dcc1a72fp-5, 0x1.569efa4a785d2p-1),
                                  V(0x1.90461312d9806p-2, -0x1.ae7f3de392befp-1, -0x1.7f774932aefdap-2))};
  const Obb<double> ground{V(0, 0, 0), V(228, 275.75, 0.25), Mat3<double>::Identity()};
  const Moving falling{stone, V(-0x1.3daeaf976e788p-54, 0, 1.125)};
  const ClosedForm<double> within_gap{0.5};
  const auto toi = time_of_impact(within_gap, falling, at_rest(ground));
  EXPECT_EQ(toi.status, hit);
  EXPECT_NEAR(toi.time, 1.200274447733641459814e-14, 8e-16);
  EXPECT_EQ(time_of_impact(within_gap, at_rest(ground), falling).time, toi.time);
}

// What two faces share may be a sliver that roundings part; and the place of a ball is moved where its time is settled.
TEST(HardQueries, where_shapes_touch_lies_on_both) {
  const auto expect_on = [](const V& point, const V& center, const V& half, const Mat3<double>& axes, double within) {
    const V own = axes.transpose() * (point - center);
    for (int i = 0; i < 3; ++i) EXPECT_LE(std::abs(own[i]), half[i] + within) << i;
  };
  const Mat3<double> upright = Mat3<double>::Identity();
  const Obb<double> chip{V(0x1.1ca999999999ap+9, -0x1.3d9cccccccccdp+8, 0),
                         V(0x1.999999999999ap-4, 0x1.999999999999ap-4, 0x1.999999999999ap-3), upright};
  const Obb<double> rod{V(0, 0, 0), V(0x1.729999999999ap+8, 0.5, 0x1.999999999999ap-3), upright};
  const V across(-453.5, 0x1.6a4cccccccccdp+8, 0);
  const auto corner = time_of_impact(Moving{chip, across}, at_rest(rod));
  expect_on(corner.point, rod.center, rod.half_extents, upright, 4e-13);
  expect_on(corner.point, chip.center + across * corner.time, chip.half_extents, upright, 4e-13);

  const double lean = 0x1.a79394c9e8a0ap-53;
  const Moving<Aabb<double>> plank{{V(100.5, -0x1.d7a19f786b0e3p+8, -0x1.d7219f786b0e1p+8), V(41.75, 0.75, 0.125)},
                                   V(1.25, 0x1.d4604a6ece284p+8, 0x1.dabd76fba1f0fp+8)};
  const Moving<Obb<double>> brick{
      {V(100, 0, 0), V(0.25, 0.125, 0.5), leaning(V(-lean, 0, 1), V(0, 1, 0), V(-1, 0, -lean))},
      V(1.75, -0x1.80aa84ce72f89p+1, 0x1.adebc19b71704p+1)};
  const auto edge = time_of_impact(plank, brick);
  expect_on(edge.point, pose_at(plank, edge.time).center, plank.shape.half_extents, upright, 4e-13);
  expect_on(edge.point, pose_at(brick, edge.time).center, brick.shape.half_extents, brick.shape.axes, 4e-13);

  const Moving ball{Sphere<double>{V(-0x1.5bb06d2fad93p+8, 0x1.31c399bcecb28p+2, 0), 1.25},
                    V(0x1.125999999999ap+9, -0x1.999999999999ap-4, 0)};
  const Obb<double> block{V(0, 0, 0), V(2.5, 0x1.4cccccccccccdp+1, 0x1.a666666666666p+1),
                          leaning(V(0x1.0000000000001p-1, 0x1.bb67ae8584caap-1, 0),
                                  V(-0x1.bb67ae8584caap-1, 0x1.0000000000001p-1, 0), V(0, 0, 1))};
  const auto beside = time_of_impact(ball, at_rest(block));
  expect_on(beside.point, block.center, block.half_extents, block.axes, 1e-14);
}

// Edges 2^-50 from parallel, crossed by the roundings of their numbers, say nothing of the plane that the time is of.
TEST(HardQueries, boxes_all_but_parallel_have_one_normal_both_ways) {
  const double s = 0x1.1ffc3403d8249p-6, r = 0x1.1ffc3403d8209p-6, c = 0x1.ffebc0222be8fp-1;
  const V down(0x1.1a62633145c07p-54, 0, -1);
  const Moving a{Obb<double>{V(0, 0, 0), V(0x1.7404130606c45p+0, 1, 1),
                             leaning(down, V(s, c, 0x1.3daa7f6e1b6bep-60), V(c, -s, 0x1.1a57381ff22dep-54))},
                 V(0, 0, 0)};
  const Moving b{Obb<double>{V(-0x1.fbf6f99c83746p+0, 0x1.d8dffad341be8p-1, -0x1.39fca33e33e2ep+1), V(1, 1, 1),
                             leaning(down, V(r, c, 0x1.3daa7f6e1b677p-60), V(c, -r, 0x1.1a57381ff22dep-54))},
                 V(0x1.0475d0e125551p-9, 0x1.f6ebde820d27dp-10, -0x1.fffffffffffffp-10)};
  const V there = time_of_impact(a, b).normal, back = time_of_impact(b, a).normal;
  EXPECT_NEAR(there[1], s, 1e-10);
  EXPECT_LE(largest<double>(there + back), 1e-10);
}

TEST(HardQueries,
     boxes_that_slide_along_each_other_touch_by_the_faces_that_do) {  // not by those whose shadows came last, long ago
  const double c = 0x1.ff747ada7ac16p-1, s = 0x1.79e106eef4478p-5;
  const auto a = at_rest(
      Obb<double>{V(0, 0, 0), V(0, 1, 1), leaning(V(c, c * 0x1p-36, -s), V(-0x1p-36, 1, 0), V(s, s * 0x1p-36, c))});
  const Moving b{Obb<double>{V(0x1.2f3c20ddb3c83p-2, 0x1.69691690489d5p-2, 0x1.ffba3d6d3d60bp+0), V(0.25, 0.25, 1),
                             Mat3<double>::Identity()},
                 V(0, 0x1.e42b9c97e72bp-3, 0)};
  const auto there = time_of_impact(a, b), back = time_of_impact(b, a);
  for (const auto& toi : {there, back}) {
    EXPECT_NE(toi.status, ToiStatus::apart);
    EXPECT_EQ(toi.time, 0);
  }
  EXPECT_NEAR(there.normal[2], 1, 1e-10);
  EXPECT_NEAR(back.normal[2], -1, 1e-10);
}

TEST(HardQueries, a_ray_along_a_capsule_to_rounding_passes_it_by) {  // 5e-4 of its radius off
  const Capsule<double> rod{V(0, 0, 0), V(0x1.4b3576a8f911fp-2, 0x1.4b36ee9562358p-61, -0x1.f305019693d28p-10), 4};
  EXPECT_FALSE(raycast(Ray<double>{V(0x1.d263bf211df98p-8, 0, -0x1.0021d260345bfp+2),
                                   V(-0x1.fffdbae348fa1p-8, 0, 0x1.81b2d8de59e6ep-15)},
                       rod));
}

TEST(HardQueries,
     a_box_is_as_far_from_a_long_segment_as_from_its_near_end) {  // whose other end's roundings are as large
  Mat3<float> axes;
  axes << 0, -1, 0, 0, 0, 1, 1, 0, 0;
  const Obb<float> box{F(-0x1.7e71ep-1F, 0x1.404d9p-1F, -0x1.3fp+2F), F(0x1.df4588p-1F, 1, 0x1.333334p-1F), axes};
  const Capsule<float> rod{F(0, -0x1.333334p-2F, 0x1.333334p-2F), F(0, 5, 0x1p+22F), 0x1p-12F};
  EXPECT_NEAR(separation(rod, box).distance, 4.3602263F, 1e-5F);
}

TEST(HardQueries, parallel_boxes_have_a_normal) {
  Mat3<float> axes;
  axes.col(0) << 0x1.f07c2p-1F, 0x1.f07c2p-3F, 0x1.f07c2p-6F;
  axes.col(1) << -0x1.f07c2p-3F, 0x1.e0f83ep-1F, 0x1.f07c2p-3F;
  axes.col(2) << 0x1.f07c2p-6F, -0x1.f07c2p-3F, 0x1.f07c2p-1F;
  const Moving first{Obb<float>{F(-2, -2, -2), F(2, 4, 2), axes}, F(-2, 3, -2)};
  const Moving second{Obb<float>{F(0x1.e0f84p+0F, -0x1.07c1fp+0F, -0x1.e0f83ep+0F), F(2, 2, 2), axes}, F(-2, -2, -2)};
  const auto toi = time_of_impact(first, second);  // they touch at the start, to float's rounding of the axes
  ASSERT_NE(toi.status, ToiStatus::apart);
  EXPECT_NEAR(toi.time, 0, 1e-6);
  EXPECT_NEAR(toi.normal.norm(), 1, 1e-6);
}

TEST(HardQueries, small_triangle_and_far_sphere) {
  const Triangle<float> triangle{F(-0x1.99999ap-1F, -0x1.266666p+2F, -0x1.99999ap-1F),
                                 F(0x1.99999ap-1F, -0x1.99999ap-1F, 0x1.4p+2F), F(0x1.266666p+2F, -1, -0x1.acccccp+2F)};
  const Sphere<float> sphere{F(-0x1.7ffff8p+1F, 0x1p+53F, -4), 0x1.99999ap-1F};
  const auto apart = separation(triangle, sphere);
  EXPECT_FLOAT_EQ(apart.distance, 0x1p+53F);
  EXPECT_FLOAT_EQ(apart.normal[1], 1);
}

TEST(HardQueries, ray_from_inside_an_enormous_sphere_stays_at_its_origin) {
  const Ray<float> ray{F(0x1.8008p-136F, -0x1.1414bp-65F, 0x1.2a85d4p-94F), F(0x1p+125F, 0, 0), 1};
  const auto hit = raycast(ray, Sphere<float>{F(0, 0x1.544214p+14F, 0), 0x1.debf28p+122F});
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->t, 0);
  EXPECT_EQ(hit->point, ray.origin);
}

// ---- Shapes in touch, or as near as rounding can tell, where the side one is seen from is noise. Found by feeding raw numbers
// to every pair.

TEST(TouchToRounding, center_ray_that_starts_in_what_its_body_does_not_overlap_has_a_normal) {
  // it lies in the triangle exactly, but its radius is less than what rounding takes it off
  const V motion(-5, 7, 3);
  const Moving capsule{Capsule<double>{V(2.984375, 3.265625, -5.25), V(2.890625, 3.171875, -5), 0x1p-611}, motion};
  const auto triangle = at_rest(Triangle<double>{V(2, 2, -3), V(5, 5, -11), V(4, 5, -7)});
  const auto toi = time_of_impact(CentreRay<double>{}, capsule, triangle);
  EXPECT_EQ(toi.status, ToiStatus::hit);
  EXPECT_EQ(toi.time, 0);
  EXPECT_LE(largest<double>(toi.normal - motion.normalized()), 1e-15);
}

TEST(TouchToRounding, center_ray_of_numbers_far_apart_misses_as_its_body_does) {
  const Moving capsule{Capsule<double>{V(-0x1.63c000000ffcep+353, -0x1.50ef63ccea089p-197, -0x1.31b628f713334p-947),
                                       V(-0x1.bb9060faaba8dp-193, 0x1.2203537bc019dp-658, -0x1.cae542c69b37dp-963),
                                       0x1.be2dc8a9cc467p-729},
                       V(-0x1.489315528e02dp+814, -0x1.13001db6dbcb7p+909, 0x1.b9568f3df17bdp+863)};
  const Moving triangle{Triangle<double>{V(0x1.73f21c0cfd2p+511, 0x1.94764ded94e81p+371, 0x1.023c321612732p-489),
                                         V(-0x1.4dc398c4afa1dp-336, 0x1.825410b836332p-827, 0x1.1a3ba5e0403d9p+118),
                                         V(-0x1.ecdc9ffbd5043p+815, -0x1.9c802c9249b13p+910, -0x1.ba8a47251275dp-680)},
                        V(-0x1.0de9883421985p-472, -0x1.fe9de77ec61e5p+817, 0x1.b9568f3df17bdp+863)};
  EXPECT_EQ(time_of_impact(capsule, triangle).status, ToiStatus::apart);
  EXPECT_EQ(time_of_impact(CentreRay<double>{}, capsule, triangle).status, ToiStatus::apart);
}

/// How far apart the plane across the separation's normal shows two sets of corners, rounded by R, to be.
double parted(const V& n, const std::vector<V>& a, const std::vector<V>& b, double R) {
  double ahead = -1e300, behind = 1e300;
  for (const V& x : a) ahead = std::max(ahead, n.dot(x));
  for (const V& x : b) behind = std::min(behind, n.dot(x));
  return behind - ahead - R;
}

TEST(TouchToRounding,
     capsule_and_triangle_are_parted_by_their_normal_by_all_of_the_gap) {  // not by the slope of an edge
  const Capsule<double> capsule{V(-8, -8, -0x1.fffffff8p+2), V(-0x1.fffffff8p+2, 0x1.bfbbb8p-1, -0x1.fffffff8p+2),
                                0x1.fffffff8p+2};
  const Triangle<double> triangle{V(-0x1.0dafecp-28, -0x1.fffffff8p+2, -0x1.fffffff8p+2),
                                  V(-0x1.0dafecp-28, 0x1.0000000000002p+1, 2), V(0x1.1333332d17d36p+3, 8, 5)};
  const auto gap = separation(capsule, triangle);
  EXPECT_NEAR(parted(gap.normal, {capsule.a, capsule.b}, {triangle.a, triangle.b, triangle.c}, capsule.radius),
              gap.distance, 1e-14);
}

TEST(TouchToRounding,
     sphere_beside_an_edge_and_all_but_its_corner_is_parted_by_the_edge) {  // 2e-9 of it from the corner
  const Triangle<double> t{V(-7, 3, -8), V(-8, 3, 0), V(-6, 0x1.00000004p+2, -0x1.00000004p+2)};
  const Sphere<double> ball{V(0, 0, -2), 7};
  const auto gap = separation(t, ball);
  EXPECT_NEAR(parted(gap.normal, {t.a, t.b, t.c}, {ball.center}, ball.radius), gap.distance, 1e-14);
}

TEST(TouchToRounding, boxes_beside_each_other_are_parted_by_an_axis) {
  const Obb<double> upper{V(-1, 1, 1), V(1, 1, 1), Mat3<double>::Identity()};
  const Aabb<double> lower{V(-1, -1, -1), V(0x1.ffffffffcp-1, 0x1.cc0aap-4, 2)};
  const auto gap = separation(upper, lower);
  EXPECT_EQ(gap.normal, V(0, -1, 0));
  EXPECT_EQ(gap.distance, 1 - 0x1.cc0aap-4);
}

TEST(TouchToRounding, parallel_rods_are_parted_across_them) {  // not from one's end to the other's, 2^-24 further on
  const Mat3<double> axes = testing::turn_in_plane(0, 1, 0.6, 0.8);
  const V half(0x1p-20, 0x1p-25, 7);
  const auto gap = separation(Obb<double>{V(0x1p-25, -7, 0x1p-24), half, axes}, Obb<double>{V(1, 4, 0), half, axes});
  EXPECT_NEAR(gap.normal[2], 0, 1e-14);
}

TEST(TouchToRounding, ray_from_afar_through_a_capsule_hits_it) {  // in float a place on the path is known to 4 lengths
  const Capsule<float> capsule{F(0, 4, 0x1.fffffcp+0F), F(-0.4F, 0, -0.15F), 0x1.fffffcp+0F};
  for (const float x : {0.375F, -0.125F}) {
    const Ray<float> ray{F(x, 0x1p+26F, 0.5F), F(2, -0x1p+27F, 0), 1};
    const auto hit = raycast(ray, capsule);
    ASSERT_TRUE(hit) << x;
    EXPECT_NEAR(hit->t, 0.5F, 0x1p-23F);
    const Obb<float> box{F(0, 2, 1), F(2, 2, 2), Mat3<float>::Identity()};
    EXPECT_TRUE(raycast(ray, box)) << x;
  }
}

TEST(TouchToRounding, center_at_the_corner_of_a_sliver_is_no_distance_from_it) {
  const float r = 0x1.00004p+3F;
  const auto gap = separation(Triangle<float>{F(-0x1.f8028cp-1F, -0x1.f908p-1F, 0), F(r, r, r), F(r, 0x1.004p+3F, r)},
                              Sphere<float>{F(r, r, r), r});
  EXPECT_NEAR(gap.distance, -r, 2e-6F);
}

TEST(TouchToRounding, center_at_a_corner_of_a_sliver_parts_from_it_along_its_plane) {
  const Triangle<double> sliver{V(0, 0, 0), V(-0x1.2b67a1f2f18d2p-3, 0x1.d4d5b3696c656p-1, 0x1.7f54313945292p-2),
                                V(0x1.d09c6566edf8p-5, -0x1.6bc3bdcc9238ap-2, -0x1.296bdf24fbad1p-3)};
  const Sphere<double> ball{V(0, 0, 0), 1};
  const auto found = contact(sliver, ball);
  ASSERT_TRUE(found);
  EXPECT_NEAR(separation(sliver, moved<double>(ball, V(found->normal * found->penetration))).distance, 0, 1e-14);
}

TEST(TouchToRounding, boxes_with_two_equally_near_pairs_keep_their_bits_at_any_scale) {
  const double h = 0x1.3333333333334p-1;
  const Obb<double> a{V(2, 4, 6), V(h, h, h), testing::turn_in_plane(0, 1, 0.6, 0.8)};
  const Obb<double> b{V(-h, -h, -h), V(h, h, h), testing::turn_in_plane(2, 0, 0.6, 0.8)};
  const auto near = separation(a, b);
  for (const int e : {-700, 700}) {
    const auto far = separation(scaled(a, e), scaled(b, e));
    EXPECT_EQ(far.distance, times_power_of_two(near.distance, e)) << e;
    EXPECT_EQ(far.normal, near.normal) << e;
  }
}

TEST(TouchToRounding,
     boxes_of_the_least_sizes_are_in_contact_where_they_overlap) {  // sizes of which no half is a number
  const double third = -0x1.4a5294a5294a5p-3, most = 0x1.ef7bdef7bdef8p-1, rest = 0x1.8c6318c6318c6p-3;
  const Obb<double> a{V(0, 0, 0), V(1, 1, 2),
                      leaning(V(third, most, rest), V(rest, third, most), V(most, rest, third))};
  const Aabb<double> b{V(-1, -1, -3), V(2, 3, 2)};
  for (const int e : {0, -1074}) {
    const auto tiny_a = scaled(a, e);
    const auto tiny_b = scaled(b, e);
    EXPECT_TRUE(overlaps(tiny_a, tiny_b)) << e;
    EXPECT_TRUE(contact(tiny_a, tiny_b)) << e;
    EXPECT_FALSE(manifold(tiny_a, tiny_b).empty()) << e;
    EXPECT_EQ(separation(tiny_a, tiny_b).normal, separation(a, b).normal) << e;
  }
}

TEST(TouchToRounding, center_in_a_triangle_that_its_body_misses_does_not_hit_it_at_rest) {
  const auto segment = at_rest(Capsule<double>{V(-1, 6, 2), V(-6, -2.5, -2.5), 0});
  const double huge = std::numeric_limits<double>::max();
  const auto triangle = at_rest(Triangle<double>{V(-2.5, huge, -6.25), V(-0.5, -0x1p+52, 0x1p-4), V(-7.984375, 0, -8)});
  EXPECT_EQ(time_of_impact(segment, triangle).status, ToiStatus::apart);
  EXPECT_EQ(time_of_impact(CentreRay<double>{}, segment, triangle).status, ToiStatus::apart);
}

}  // namespace

}  // namespace thinwall
