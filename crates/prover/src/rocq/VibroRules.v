(* The steps of a proof as lemmas: terms and their numerators, linear combinations, signs, cases. *)
Require Import Reals Lra Lia Psatz Nsatz.
Require Import Coquelicot.Coquelicot.
Require Export VibroAxioms VibroOperations.
Open Scope R_scope.

(* P is the numerator of the term T, which divides by what D is made of. *)
Lemma numerator_zero T D P : T = 0 -> P = T * D -> P = 0.
Proof. intros -> ->. ring. Qed.

Lemma numerator_nonzero T D P : T <> 0 -> D <> 0 -> P = T * D -> P <> 0.
Proof. intros HT HD ->. apply Rmult_integral_contrapositive_currified; assumption. Qed.

Lemma numerator_positive T S P : T > 0 -> S <> 0 -> P = T * S ^ 2 -> P > 0.
Proof. intros HT HS ->. apply Rmult_gt_0_compat; [assumption|]. apply Rlt_gt. rewrite <- Rsqr_pow2. apply Rlt_0_sqr. assumption. Qed.

Lemma numerator_nonnegative T S P : T >= 0 -> P = T * S ^ 2 -> P >= 0.
Proof. intros HT ->. apply Rle_ge. apply Rmult_le_pos; [apply Rge_le; assumption|]. apply pow2_ge_0. Qed.

(* A term from a fact F, a multiple of its numerator. *)
Lemma zero_of T D c F : F = 0 -> D <> 0 -> T * D = c * F -> T = 0.
Proof. intros -> HD E. rewrite Rmult_0_r in E. apply Rmult_integral in E. tauto. Qed.

Lemma nonzero_of T D c F : F <> 0 -> c <> 0 -> T * D = c * F -> T <> 0.
Proof. intros HF Hc E Z. rewrite Z, Rmult_0_l in E. symmetry in E. apply Rmult_integral in E. tauto. Qed.

Lemma positive_of T S c F : F > 0 -> c > 0 -> T * S ^ 2 = c * F -> T > 0.
Proof.
  intros HF Hc E. assert (0 < T * S ^ 2) by (rewrite E; apply Rmult_lt_0_compat; assumption).
  assert (0 <= S ^ 2) by apply pow2_ge_0. nra.
Qed.

Lemma nonnegative_of T S c F : F >= 0 -> c > 0 -> S <> 0 -> T * S ^ 2 = c * F -> T >= 0.
Proof.
  intros HF Hc HS E. assert (0 <= T * S ^ 2) by (rewrite E; apply Rmult_le_pos; lra).
  assert (0 < S ^ 2) by (rewrite <- Rsqr_pow2; apply Rlt_0_sqr; assumption). apply Rle_ge. nra.
Qed.

(* A linear combination of what is 0 is 0. *)
Lemma no_terms : 0 = 0.
Proof. reflexivity. Qed.

Lemma term c F r : F = 0 -> r = 0 -> c * F + r = 0.
Proof. intros -> ->. ring. Qed.

(* A product of what is not 0, of what is positive, of what is not negative. *)
Lemma no_factors : 1 <> 0.
Proof. apply R1_neq_R0. Qed.

Lemma factor F n r : F <> 0 -> r <> 0 -> F ^ n * r <> 0.
Proof. intros HF Hr. apply Rmult_integral_contrapositive_currified; [apply pow_nonzero; assumption|assumption]. Qed.

Lemma no_positive : 1 > 0.
Proof. apply Rlt_0_1. Qed.

Lemma positive_factor F n r : F > 0 -> r > 0 -> F ^ n * r > 0.
Proof. intros HF Hr. apply Rmult_gt_0_compat; [apply pow_lt; assumption|assumption]. Qed.

Lemma no_nonnegative : 1 >= 0.
Proof. lra. Qed.

Lemma nonnegative_factor F r : F >= 0 -> r >= 0 -> F * r >= 0.
Proof. intros HF Hr. apply Rle_ge. apply Rmult_le_pos; apply Rge_le; assumption. Qed.

(* Summands: a positive number times such a product times a square. *)
Lemma no_summands : 0 >= 0.
Proof. lra. Qed.

Lemma summand c p q r : c > 0 -> p >= 0 -> r >= 0 -> c * p * q ^ 2 + r >= 0.
Proof.
  intros Hc Hp Hr. assert (0 <= c * p) by (apply Rmult_le_pos; lra). assert (0 <= q ^ 2) by apply pow2_ge_0.
  assert (0 <= c * p * q ^ 2) by (apply Rmult_le_pos; assumption). lra.
Qed.

Lemma strict_summand c p q r : c > 0 -> p > 0 -> q <> 0 -> r >= 0 -> c * p * q ^ 2 + r > 0.
Proof.
  intros Hc Hp Hq Hr. assert (0 < c * p) by (apply Rmult_lt_0_compat; assumption).
  assert (0 < q ^ 2) by (rewrite <- Rsqr_pow2; apply Rlt_0_sqr; assumption).
  assert (0 < c * p * q ^ 2) by (apply Rmult_lt_0_compat; assumption). lra.
Qed.

Lemma later_summand c p q r : c > 0 -> p >= 0 -> r > 0 -> c * p * q ^ 2 + r > 0.
Proof.
  intros Hc Hp Hr. assert (0 <= c * p) by (apply Rmult_le_pos; lra). assert (0 <= q ^ 2) by apply pow2_ge_0.
  assert (0 <= c * p * q ^ 2) by (apply Rmult_le_pos; assumption). lra.
Qed.

(* The steps `zero`, `nonzero` and `sign`: the factors times a power of the target are a combination. *)
Lemma zero_step t p c f : f <> 0 -> c = 0 -> f * t ^ p = c -> t = 0.
Proof.
  intros Hf -> E. apply Rmult_integral in E. destruct E as [E|E]; [tauto|].
  destruct (Req_dec t 0) as [Z|Z]; [assumption|]. exfalso. revert E. apply pow_nonzero. assumption.
Qed.

Lemma squares_step t p c f s : f <> 0 -> c = 0 -> s >= 0 -> f * ((t ^ p) ^ 2 + s) = c -> t = 0.
Proof.
  intros Hf -> Hs E. apply Rmult_integral in E. destruct E as [E|E]; [tauto|].
  destruct (Req_dec t 0) as [Z|Z]; [assumption|]. exfalso.
  assert (0 < (t ^ p) ^ 2) by (rewrite <- Rsqr_pow2; apply Rlt_0_sqr; apply pow_nonzero; assumption). lra.
Qed.

Lemma nonzero_step t k c f : f <> 0 -> c = 0 -> k * t = f + c -> t <> 0.
Proof. intros Hf -> E Z. apply Hf. rewrite Z in E. rewrite Rmult_0_r, Rplus_0_r in E. symmetry. assumption. Qed.

Lemma positive_step t c f s : f > 0 -> c = 0 -> s > 0 -> f * t = s + c -> t > 0.
Proof. intros Hf -> Hs E. rewrite Rplus_0_r in E. rewrite <- E in Hs. nra. Qed.

Lemma nonnegative_step t c f s : f > 0 -> c = 0 -> s >= 0 -> f * t = s + c -> t >= 0.
Proof. intros Hf -> Hs E. rewrite Rplus_0_r in E. rewrite <- E in Hs. apply Rle_ge. nra. Qed.

Lemma squeezed a b : a >= 0 -> b >= 0 -> b = - a -> a = 0.
Proof. intros. lra. Qed.

Lemma by_order a : a > 0 \/ a = 0 \/ - a > 0.
Proof. destruct (Rtotal_order a 0) as [H|[H|H]]; [right; right; lra|right; left; assumption|left; assumption]. Qed.

Lemma by_zero a : a = 0 \/ a <> 0.
Proof. apply Req_dec. Qed.

Lemma is_INR n p : p = IZR (Z.of_nat n) -> p = INR n.
Proof. intros ->. symmetry. apply INR_IZR_INZ. Qed.

Lemma is_negative_INR n p : p = - IZR (Z.of_nat n) -> p = - INR n.
Proof. intros ->. rewrite INR_IZR_INZ. reflexivity. Qed.

Lemma abs_is_root x : Rabs x = sqrt (x ^ 2).
Proof. rewrite <- Rsqr_pow2. symmetry. apply sqrt_Rsqr_abs. Qed.

(* That what a term divides by is not 0, from what is known. *)
Ltac is_known_nonzero :=
  first
    [ assumption
    | apply Rgt_not_eq; assumption
    | apply PI_neq0
    | match goal with
      | |- IZR _ <> 0 => let Z := fresh in intro Z; clear - Z; lra
      | |- ?a * ?b <> 0 => apply Rmult_integral_contrapositive_currified; is_known_nonzero
      | |- ?a ^ ?n <> 0 => apply pow_nonzero; is_known_nonzero
      end
    | match goal with
      (* what else is known would take long to look through *)
      | H : ?q <> 0 |- ?e <> 0 => let Z := fresh in intro Z; apply H; clear - Z; lra
      | H : ?q <> 0 |- ?e <> 0 => let Z := fresh in intro Z; apply H; rewrite Z; clear; ring
      | H : ?q > 0 |- ?e <> 0 =>
        let Z := fresh in intro Z; cut (q = 0); [clear - H; intro; lra | clear - Z; lra]
      end
    | lra
    | enclose ].

Ltac each_known_nonzero := repeat match goal with |- _ /\ _ => split end; is_known_nonzero.

(* The same, also from fractions that are not 0. *)
Ltac is_nonzero :=
  first
    [ is_known_nonzero
    | match goal with
      | H : ?q <> 0 |- ?e <> 0 =>
        let Z := fresh in intro Z; apply H; field_simplify_eq; [clear - Z; lra | clear Z; each_known_nonzero]
      end ].

Ltac nonzero := repeat match goal with |- _ /\ _ => split end; is_nonzero.

(* Equality of quotients of polynomials. *)
Ltac same_fraction :=
  lazymatch goal with
  | |- context [_ / _] => first [field; nonzero | ring]
  | _ => first [ring | field; nonzero]
  end.

(* Two sides are equal whose difference, perhaps written otherwise, is 0. *)
Ltac same_sides H :=
  first [exact (Rminus_diag_uniq _ _ H) | apply Rminus_diag_uniq; rewrite <- H; simpl Z.of_nat; same_fraction].

(* Printed functions by those of the proof. *)
Ltac by_definition := unfold tan, sinh, cosh, tanh; rewrite ?abs_is_root.
Ltac by_definition_in H := unfold tan, sinh, cosh, tanh in H; rewrite ?abs_is_root in H.

(* A property of a term from what is printed. *)
Ltac as_printed H :=
  by_definition_in H;
  first
    [ exact H
    | exact (Rminus_diag_eq _ _ H)
    | exact (Rminus_eq_contra _ _ H)
    | exact (Rgt_minus _ _ H)
    | exact (Rge_minus _ _ H)
    | lra
    | apply Rminus_eq_contra; intro; apply H; lra
    | apply Rminus_diag_eq; same_printed H ]
with same_printed H := first [rewrite <- H | rewrite H]; same_fraction.

(* What is 0 at every time has the slope 0. *)
Lemma slope_of_zero (f g : R -> R) : (forall t : R, f t = 0) -> (forall t : R, is_derive f t (g t)) -> forall t : R, g t = 0.
Proof.
  intros Hf Hg t. transitivity (Derive f t); [symmetry; apply is_derive_unique; apply Hg|]. apply is_derive_unique. apply is_derive_ext with (f := fun _ => 0); [intro; symmetry; apply Hf|].
  apply D_const.
Qed.

Ltac differentiate_smooth :=
  repeat match goal with H : forall T, is_derive ?f T (?g T) |- context [?f ?t] =>
    lazymatch goal with
    | K : is_derive f t (g t) |- _ => fail
    | _ => pose proof (H t)
    end
  end;
  differentiate.

(* A function with the derivative 0 is constant: on a line, and in a flight. *)
Lemma derivative_is (f : R -> R) (x s : R) : is_derive f x s -> s = 0 -> is_derive f x 0.
Proof. intros D <-. exact D. Qed.

Lemma constant_between (f : R -> R) (a b : R) : a <= b -> (forall t : R, a <= t <= b -> is_derive f t 0) -> f a = f b.
Proof. intros [L | <-] D; [apply (eq_is_derive f a b D L) | reflexivity]. Qed.

Lemma constant_in_flight (f : R -> R) (a b : R) : (forall t : R, a <= t <= b -> is_derive f t 0) ->
  forall t s : R, a <= t <= b -> a <= s <= b -> f t - f s = 0.
Proof.
  intros D t s T S. apply Rminus_diag_eq. destruct (Rle_dec t s) as [L | L].
  - apply constant_between; [exact L | intros u U; apply D; lra].
  - symmetry. apply constant_between; [lra | intros u U; apply D; lra].
Qed.

Lemma constant_everywhere (f : R -> R) : (forall t : R, is_derive f t 0) -> forall t s : R, f t - f s = 0.
Proof.
  intros D t s. apply (constant_in_flight f (Rmin t s) (Rmax t s)); [intros u _; apply D | |];
    (split; [apply Rmin_l || apply Rmin_r | apply Rmax_l || apply Rmax_r]).
Qed.

(* What is 0 near a point, perhaps on one side of it, has the slope 0 there. *)
Lemma slope_of_zeros (f : R -> R) (x l : R) : f x = 0 ->
  (forall d : R, 0 < d -> exists u : R, u <> x /\ Rabs (u - x) < d /\ f u = 0) -> is_derive f x l -> l = 0.
Proof.
  intros Z A D. apply is_derive_Reals in D.
  destruct (Req_dec l 0) as [E | E]; [exact E | exfalso].
  destruct (D (Rabs l) (Rabs_pos_lt l E)) as [d H].
  destruct (A d (cond_pos d)) as (u & U & N & F).
  assert (K : u - x <> 0) by lra.
  specialize (H (u - x) K N). replace (x + (u - x)) with u in H by ring.
  rewrite F, Z in H. replace ((0 - 0) / (u - x) - l) with (- l) in H by (field; exact K).
  rewrite Rabs_Ropp in H. lra.
Qed.

Lemma slope_of_zero_near (f : R -> R) (x l : R) : locally x (fun u => f u = 0) -> is_derive f x l -> l = 0.
Proof.
  intros N. apply slope_of_zeros; [exact (locally_singleton _ _ N) |].
  intros d P. destruct N as [e N]. exists (x + Rmin (e / 2) (d / 2)).
  assert (E := cond_pos e). assert (M : 0 < Rmin (e / 2) (d / 2)) by (apply Rmin_pos; lra).
  assert (L := Rmin_l (e / 2) (d / 2)). assert (L' := Rmin_r (e / 2) (d / 2)).
  assert (V : Rabs (x + Rmin (e / 2) (d / 2) - x) = Rmin (e / 2) (d / 2))
    by (replace (x + Rmin (e / 2) (d / 2) - x) with (Rmin (e / 2) (d / 2)) by ring; apply Rabs_pos_eq; lra).
  split; [lra | split; [rewrite V; lra |]].
  apply N. change (Rabs (x + Rmin (e / 2) (d / 2) - x) < e). rewrite V. lra.
Qed.

Lemma slope_nearby (f : R -> R) (P : R -> Prop) (x l : R) : (forall u : R, P u -> f u = 0) -> locally x P -> is_derive f x l -> l = 0.
Proof. intros Z N. apply slope_of_zero_near. exact (filter_imp _ _ Z N). Qed.

Lemma slope_in_flight (f : R -> R) (P : R -> Prop) (a b x l : R) : a < b ->
  (forall u : R, a <= u <= b -> P u -> f u = 0) -> a <= x <= b -> locally x P -> is_derive f x l -> l = 0.
Proof.
  intros O Z I N. apply slope_of_zeros; [apply Z; [exact I | exact (locally_singleton _ _ N)] |].
  intros d H. destruct N as [e N]. assert (E := cond_pos e).
  set (h := Rmin (Rmin (e / 2) (d / 2)) ((b - a) / 2)).
  assert (M : 0 < h) by (repeat apply Rmin_pos; lra).
  assert (L : h <= (b - a) / 2) by apply Rmin_r.
  assert (L' : h <= Rmin (e / 2) (d / 2)) by apply Rmin_l.
  assert (L1 := Rmin_l (e / 2) (d / 2)). assert (L2 := Rmin_r (e / 2) (d / 2)).
  destruct (Rle_dec x ((a + b) / 2)) as [C | C].
  - exists (x + h). assert (V : Rabs (x + h - x) = h) by (replace (x + h - x) with h by ring; apply Rabs_pos_eq; lra).
    split; [lra | split; [rewrite V; lra |]]. apply Z; [lra |].
    apply N. change (Rabs (x + h - x) < e). rewrite V. lra.
  - exists (x - h). assert (V : Rabs (x - h - x) = h) by (replace (x - h - x) with (- h) by ring; rewrite Rabs_Ropp; apply Rabs_pos_eq; lra).
    split; [lra | split; [rewrite V; lra |]]. apply Z; [lra |].
    apply N. change (Rabs (x - h - x) < e). rewrite V. lra.
Qed.

(* Conditions that hold nearby. *)
Lemma positive_nearby (f : R -> R) (x : R) : ex_derive f x -> f x > 0 -> locally x (fun u => f u > 0).
Proof.
  intros D P. apply (ex_derive_continuous f x D (fun y => y > 0)). exact (open_gt 0 (f x) P).
Qed.

Lemma nonzero_nearby (f : R -> R) (x : R) : ex_derive f x -> f x <> 0 -> locally x (fun u => f u <> 0).
Proof.
  intros D P. apply (ex_derive_continuous f x D (fun y => y <> 0)). exact (open_neq 0 (f x) P).
Qed.

Lemma nonnegative_nearby (f : R -> R) (x : R) : ex_derive f x -> f x >= 0 -> f x <> 0 -> locally x (fun u => f u >= 0).
Proof.
  intros D P N. apply (filter_imp (fun u => f u > 0)); [intros u U; lra |]. apply positive_nearby; [exact D | lra].
Qed.

Ltac is_known := cbv beta; first [assumption | lra].

Ltac near_one :=
  lazymatch goal with
  | |- locally _ (fun _ => True) => apply filter_forall; intro; exact Logic.I
  | |- locally _ (fun _ => ?P) => apply filter_forall; intro; assumption
  | |- locally ?x (fun u => @?f u > 0) => apply (positive_nearby f x); [eexists; differentiate_smooth | is_known]
  | |- locally ?x (fun u => @?f u <> 0) => apply (nonzero_nearby f x); [eexists; differentiate_smooth | is_known]
  | |- locally ?x (fun u => @?f u >= 0) => apply (nonnegative_nearby f x); [eexists; differentiate_smooth | is_known | is_known]
  end.

Ltac near_by :=
  lazymatch goal with
  | |- locally ?x (fun u => @?A u /\ @?B u) => apply (filter_and (F := locally x) A B); [near_one | near_by]
  | _ => near_one
  end.

(* A time of a flight: one of its ends, or one that runs over it. *)
Ltac within_flight :=
  first [assumption | split; first [apply Rle_refl | assumption | apply Rlt_le; assumption | lra]].

(* What holds wherever a map starts near a point. *)
Definition near_1 (P : R -> Prop) (a : R) : Prop := exists e : R, 0 < e /\ forall x : R, Rabs (x - a) < e -> P x.

Definition near_2 (P : R -> R -> Prop) (a b : R) : Prop :=
  exists e : R, 0 < e /\ forall x y : R, Rabs (x - a) < e -> Rabs (y - b) < e -> P x y.

Definition near_3 (P : R -> R -> R -> Prop) (a b c : R) : Prop :=
  exists e : R, 0 < e /\ forall x y z : R, Rabs (x - a) < e -> Rabs (y - b) < e -> Rabs (z - c) < e -> P x y z.

Lemma near_itself (x e : R) : 0 < e -> Rabs (x - x) < e.
Proof. intro P. rewrite Rminus_diag_eq by reflexivity. rewrite Rabs_R0. exact P. Qed.

(* The printed claim from the goal that steps have shown. *)
Ltac by_sides W :=
  match type of W with
  | ?a - ?b = 0 =>
    match goal with
    | |- ?l = ?r =>
      transitivity a;
      [ first [reflexivity | ring]
      | transitivity b; [exact (Rminus_diag_uniq _ _ W) | first [reflexivity | ring]] ]
    end
  end.

Ltac conclude W :=
  cbv zeta;
  first
    [ exact W
    | exact (Rminus_diag_uniq _ _ W)
    | by_definition;
      first
        [ exact W
        | exact (Rminus_diag_uniq _ _ W)
        | exact (Rminus_not_eq _ _ W)
        | by_sides W
        | lra
        | let Z := fresh in intro Z; apply W; lra
        | destruct (Rmult_integral _ _ W); [left | right]; lra
        | apply Rminus_diag_uniq; rewrite <- W; same_fraction ] ].

(* Values at a point: functions at arguments where they have well-known values. *)
Ltac known_values :=
  rewrite ?sin_0, ?cos_0, ?sin_PI, ?cos_PI, ?sin_2PI, ?cos_2PI, ?sin_PI2, ?cos_PI2, ?exp_0, ?ln_1, ?sqrt_0, ?sqrt_1, ?atan_0, ?tan_0.

Lemma root_squared a : 0 <= a -> sqrt a ^ 2 = a.
Proof. intro H. rewrite <- Rsqr_pow2. apply Rsqr_sqrt. assumption. Qed.

(* Square roots of closed terms become letters with a square. *)
Ltac roots_as_letters :=
  repeat
    match goal with
    | |- context [sqrt ?a] =>
      lazymatch a with
      | context [sqrt _] => fail
      | _ =>
        let H := fresh "R" in
        let K := fresh "R" in
        first
          [ assert (K : sqrt a > 0) by (apply sqrt_lt_R0; first [lra | apply Rgt_lt; enclose])
          | assert (K : sqrt a >= 0) by (apply Rle_ge; apply sqrt_pos) ];
        assert (H : sqrt a ^ 2 = a) by (apply root_squared; first [lra | apply Rlt_le; enclose]);
        revert H K; generalize (sqrt a); intros ? H K
      end
    end.

(* What follows from equations alone: what else is known stands in the way. *)
Ltac by_equations :=
  first
    [ assumption
    | repeat match goal with H : _ > _ |- _ => clear H | H : _ >= _ |- _ => clear H | H : _ <> _ |- _ => clear H end; nsatz ].

Ltac equal_at_point :=
  first
    [ reflexivity
    | lra
    | ring
    | field; nonzero
    | progress known_values; equal_at_point
    | progress rewrite ?sin_plus, ?cos_plus, ?sin_minus, ?cos_minus; equal_at_point
    | progress integer_powers; equal_at_point
    | progress roots_as_letters; first [solve [by_equations] | solve [field_simplify_eq; first [by_equations | nonzero]]] ].

(* A closed proposition, by evaluation. *)
Ltac at_point :=
  by_definition;
  match goal with
  | |- forall _, _ => intros; at_point
  | |- ?a = ?b => equal_at_point
  | |- ?a <> ?b => first [lra | apply Rminus_not_eq; enclose | intro; lra]
  | |- ?a > ?b => first [lra | apply Rminus_gt; enclose]
  | |- ?a < ?b => first [lra | apply Rminus_gt_0_lt; apply Rgt_lt; enclose]
  | |- ?a >= ?b => first [lra | apply Rgt_ge; apply Rminus_gt; enclose | apply Req_ge; equal_at_point]
  | |- ?a <= ?b => first [lra | apply Rlt_le; apply Rminus_gt_0_lt; apply Rgt_lt; enclose | apply Req_le; equal_at_point]
  | |- integer _ => is_integer
  | |- is_derive _ _ _ => cbv beta; differentiate_smooth
  end.

(* The next hypothesis of a theorem at a point. *)
Ltac meet X :=
  match type of X with
  | ?P -> _ => let H := fresh "M" in assert (H : P); [at_point | specialize (X H); clear H]
  end.

(* A letter for a value. *)
Lemma has_name {A : Type} (v : A) : exists x : A, x = v.
Proof. exists v. reflexivity. Qed.

(* A limit and an improper integral have one value. *)
Lemma one_integral (Fa Fb : (R -> Prop) -> Prop) (HFa : ProperFilter' Fa) (HFb : ProperFilter' Fb) (f : R -> R) (v w : R) :
  is_RInt_gen f Fa Fb v -> is_RInt_gen f Fa Fb w -> w = v.
Proof.
  intros X Y. rewrite <- (@is_RInt_gen_unique R_CompleteNormedModule Fa Fb HFa HFb f v X).
  symmetry. exact (@is_RInt_gen_unique R_CompleteNormedModule Fa Fb HFa HFb f w Y).
Qed.

Lemma one_limit (f : R -> R) (x v w : R) : is_lim f x v -> is_lim f x w -> w = v.
Proof. intros X Y. apply is_lim_unique in X. apply is_lim_unique in Y. rewrite X in Y. injection Y. auto. Qed.

Ltac one_value X Y :=
  let Z := fresh in
  first [assert (Z := one_limit _ _ _ _ X Y) | assert (Z := one_integral _ _ _ _ _ _ _ X Y)]; clear X Y; rename Z into X.

(* A closed claim fails. *)
Ltac fails X :=
  by_definition_in X;
  first
    [ lra
    | match type of X with
      | ?a = ?b => let N := fresh in assert (N : a - b <> 0) by enclose; apply N; lra
      | ?a <> ?b => apply X; equal_at_point
      | ?a > ?b => first [cut (b - a > 0); [intro; lra | enclose] | cut (a = b); [intro; lra | equal_at_point]]
      | ?a < ?b => first [cut (a - b > 0); [intro; lra | enclose] | cut (a = b); [intro; lra | equal_at_point]]
      | ?a >= ?b => cut (b - a > 0); [intro; lra | enclose]
      | ?a <= ?b => cut (a - b > 0); [intro; lra | enclose]
      end ].
