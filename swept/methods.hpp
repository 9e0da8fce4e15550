#pragma once
/// Every way to find a time of impact. A new method is a header of its own and one line here: tests, benchmarks and
/// experiments loop over this list and ask serves<Method, A, B>.

#include <thinwall/discrete/type_list.hpp>
#include <thinwall/swept/methods/bisection.hpp>
#include <thinwall/swept/methods/centre_ray.hpp>
#include <thinwall/swept/methods/closed_form.hpp>
#include <thinwall/swept/methods/conservative_advancement.hpp>
#include <thinwall/swept/methods/inclusion.hpp>
#include <thinwall/swept/methods/speculative.hpp>
#include <thinwall/swept/methods/substeps.hpp>
#include <thinwall/swept/methods/sweep_then_confirm.hpp>
#include <thinwall/swept/methods/swept_volume_ray.hpp>
#include <thinwall/swept/time_of_impact.hpp>

namespace thinwall {

template <Scalar S>
using Methods = TypeList<        //
    EndOfStep<S>,                //
    Substeps<S>,                 //
    CentreRay<S>,                //
    SweptVolumeRay<S>,           //
    SweepThenConfirm<S>,         //
    Speculative<S>,              //
    ConservativeAdvancement<S>,  //
    Bisection<S>,                //
    Inclusion<S>,                //
    ClosedForm<S>>;

}  // namespace thinwall
