#!/usr/bin/env python3
"""Establishes the truth of every formula in formulas.toml from formulas_check.py.
Usage: check.py [id-prefix]"""
import sys, re, random, tomllib, importlib.util, os, itertools
import mpmath as mp
HERE=os.path.dirname(os.path.abspath(__file__))
class Undef(Exception): pass
def pyname(t):
    t=t.replace('\\lambda','lam').replace("'",'p')
    t=re.sub(r'\\(text|mathrm|bar|vec)',r'',t) if False else t
    return re.sub(r'[\\_{},\s^]','',t)
def rf(f,ok):
    def g(x):
        if isinstance(x,(mp.mpc,complex)) : raise Undef
        if not ok(x): raise Undef
        return f(x)
    return g
def sqr(x):return rf(mp.sqrt,lambda x:x>=0)(x)
def cbrt_real(x): return mp.sign(x)*mp.cbrt(abs(x))
def choose(n,k):
    if k<0 or k>n: return mp.mpf(0)
    return mp.binomial(n,k)
def S(f,a,b): return mp.fsum([f(mp.mpf(k)) for k in range(int(a),int(b)+1)])
def P(f,a,b): return mp.fprod([f(mp.mpf(k)) for k in range(int(a),int(b)+1)])
def rec(init,step,n):
    """a_0.. given; a_k = step(k, a) ; returns a_n"""
    a=[mp.mpf(v) for v in init]
    while len(a)<=n: a.append(step(len(a),a))
    return a[int(n)]
def M(*rows): return mp.matrix([list(r) for r in rows])
def V(*c): return mp.matrix(list(c))
def cross(a,b): return V(a[1]*b[2]-a[2]*b[1],a[2]*b[0]-a[0]*b[2],a[0]*b[1]-a[1]*b[0])
def dot(a,b): return mp.fsum([x*y for x,y in zip(a,b)])
def nrm(a): return mp.sqrt(mp.fsum([abs(x)**2 for x in a]))
def tr(A): return mp.fsum([A[i,i] for i in range(A.rows)])
def det(A):  # cofactor expansion, exact in form
    n=A.rows
    if n==1: return A[0,0]
    return mp.fsum([(-1)**j*A[0,j]*det(mp.matrix([[A[i,k] for k in range(n) if k!=j] for i in range(1,n)])) for j in range(n)])
def inv(A):
    if det(A)==0: raise Undef
    return A**-1
def lim(f,x0,side=0,h='1e-14'):
    h=mp.mpf(h)
    if x0==mp.inf: return f(1/h)
    if x0==-mp.inf: return f(-1/h)
    if side>0: return f(x0+h)
    if side<0: return f(x0-h)
    return (f(x0+h)+f(x0-h))/2
def D(f,x,n=1): return mp.diff(f,x,n)
def I(f,*pts): return mp.quad(f,list(pts))
def doublefact(n): return mp.fac2(n)
def rnd(x): return mp.nstr(x)
base={k:getattr(mp,k) for k in 'sin cos tan cot sec csc sinh cosh tanh coth sech csch atan asinh exp pi e fac gamma beta zeta inf euler loggamma psi erf floor ceil sign fib legendre chebyt chebyu hermite laguerre bernpoly bernoulli harmonic arg conj re im mpf mpc j fsum fprod catalan hypot atan2 quad quadosc nsum ellipk ellipe besselj expm eye expj li ei phi degrees radians root'.split()}
base.update(dict(binom=choose,S=S,P=P,rec=rec,M=M,V=V,cross=cross,dot=dot,nrm=nrm,tr=tr,det=det,inv=inv,lim=lim,D=D,I=I,cbrt=cbrt_real,q=lambda a,b:mp.mpf(a)/b,abs=abs,max=max,min=min,sum=sum,range=range,sorted=sorted,int=int,len=len,all=all,any=any,zip=zip,acot=lambda x:mp.pi/2-mp.atan(x),Undef=Undef,fac2=mp.fac2,mp=mp,acot0=mp.acot))
real=dict(base); real.update(sqrt=sqr,log=rf(mp.log,lambda x:x>0),asin=rf(mp.asin,lambda x:-1<=x<=1),acos=rf(mp.acos,lambda x:-1<=x<=1),acosh=rf(mp.acosh,lambda x:x>=1),atanh=rf(mp.atanh,lambda x:-1<x<1),acoth=rf(mp.acoth,lambda x:abs(x)>1),asec=rf(mp.asec,lambda x:abs(x)>=1))
real['lg']=lambda x:real['log'](x)/mp.log(10)
def logb(b,x):
    if b<=0 or b==1: raise Undef
    return real['log'](x)/mp.log(b)
real['logb']=logb
cplx=dict(base); cplx.update({k:getattr(mp,k) for k in 'sqrt log asin acos acosh atanh acoth'.split()}); cplx['i']=mp.mpc(0,1)
def samp(rng,kind,r):
    if r:
        lo,hi=r
        if kind=='integers': return mp.mpf(rng.randint(int(lo),int(hi)))
        if kind!='complex': return mp.mpf(lo)+(mp.mpf(hi)-mp.mpf(lo))*mp.mpf(rng.getrandbits(120)|1)/mp.mpf(2)**120
    u=lambda a,b: a+(b-a)*mp.mpf(rng.getrandbits(120)|1)/mp.mpf(2)**120
    t=rng.random()
    if kind in('real','nonzero'):
        if t<.1:
            v=mp.mpf(rng.choice([0,1,-1,2,-2]))
        elif t<.25: v=u(-1,1)
        elif t<.75: v=u(-3,3)
        else: v=u(-12,12)
        if kind=='nonzero' and v==0: v=u(-3,3)
        return v
    if kind=='positive': return mp.mpf(rng.choice([1,2])) if t<.05 else u(0,1) if t<.3 else u(0,4) if t<.8 else u(0,12)
    if kind=='nonnegative': return mp.mpf(rng.choice([0,1])) if t<.1 else u(0,1) if t<.3 else u(0,4) if t<.8 else u(0,12)
    if kind=='integers': return mp.mpf(rng.randint(-6,6))
    if kind=='complex':
        if t<.06: return mp.mpc(u(-3,3),0)
        if t<.12: return mp.mpc(0,u(-3,3))
        return mp.mpc(u(-3,3),u(-3,3))
def genf(rng):
    u=lambda a,b: mp.mpf(a)+(b-a)*mp.mpf(rng.getrandbits(120)|1)/mp.mpf(2)**120
    c=[u(-2,2) for _ in range(8)]
    return lambda t: c[0]+c[1]*t+c[2]*t*t/4+c[3]*mp.sin(c[4]*t+c[5])+c[6]*mp.exp(c[7]*t/8)
def isnum_bad(v,cx):
    if isinstance(v,mp.matrix): return any(isnum_bad(x,cx) for x in v)
    if isinstance(v,(list,tuple)): return any(isnum_bad(x,cx) for x in v)
    if isinstance(v,(mp.mpc,complex)):
        return (not cx and abs(mp.im(v))>0) or mp.isnan(v) or mp.isinf(v)
    return mp.isnan(v) or mp.isinf(v)
def reldiff(a,b):
    if isinstance(a,(mp.matrix,list,tuple)) or isinstance(b,(mp.matrix,list,tuple)):
        a=list(a); b=list(b)
        if len(a)!=len(b): return mp.mpf(1)
        s=max([abs(x) for x in a+b]+[1])
        return max(abs(x-y) for x,y in zip(a,b))/s
    return abs(a-b)/max(1,min(abs(a),abs(b))) if max(abs(a),abs(b))>=1e-3 else abs(a-b)/max(abs(a),abs(b),mp.mpf('1e-14'))
RELS=[' == ',' <= ',' >= ',' < ',' > ',' != ']
def check(f,c):
    """returns (verdict or None, text)"""
    rng=random.Random(f['id']+str(c.get('seed',''))+os.environ.get('SEED',''))
    cx='complex' in f['symbols'] and f['symbols']['complex'] or c.get('cx')
    ns0=cplx if cx else real
    ex=c['expr']; dps=c.get('dps',50); mp.mp.dps=dps
    tol=mp.mpf(c.get('tol','1e-9' if f['construct']=='limit' else '1e-25'))
    if ex.startswith('approx:'):
        v,p=ex[7:].split('|'); p=p.strip()
        v=eval(v,dict(ns0)); m,_,xp=p.partition('e'); ulp=mp.mpf(10)**(-(len(m.split('.')[1]) if '.' in m else 0)+int(xp or 0))
        if 'ulp' in c: ulp=mp.mpf(c['ulp'])
        d=abs(v-mp.mpf(p))/ulp
        txt=f"value {mp.nstr(v,12)} computed at {dps} digits; printed figure off by {mp.nstr(d,3)} units of its last place (true if at most 0.5)"
        if d<=mp.mpf('0.5'): return True,txt
        return (False if d>1 else None),txt
    kinds={}
    for k,l in f['symbols'].items():
        for s in l: kinds[s]=k
    rngs={}
    for part in filter(None,[p.strip() for p in c.get('s','').split(',')]):
        n,r=part.split(':'); lo,hi=r.split('..'); rngs[n]=(lo,hi)
    want=max(c.get('n',24),int(os.environ.get('N','0')) if 'n' not in c else 0); got=0; bad=0; worst=mp.mpf(0); leastbad=None; maxbad=mp.mpf(0)
    seen=set(); nosym=not kinds and not c.get('let')
    for attempt in range(4000):
        if got>=(1 if nosym else want): break
        ns=dict(ns0)
        key=[]
        for s,k in kinds.items():
            if k=='functions':
                m=re.match(r'^(.*)\((.*)\)$',s); ns[pyname(m.group(1))]=genf(rng); key.append(attempt)
            else:
                v=samp(rng,k,rngs.get(pyname(s))); ns[pyname(s)]=v; key.append(str(v))
        if tuple(key) in seen and key: continue
        seen.add(tuple(key))
        try:
            for st in filter(None,[x.strip() for x in c.get('let','').split(';')]): exec(st,ns)
            if c.get('c') and not eval(c['c'],ns): continue
            if ex.startswith('bounded:'):
                mp.mp.dps=max(dps,80)
                g=eval(ex[8:],ns); pts=c.get('at','0')
                xs=[mp.mpf(10)**-k for k in (3,4,5,6)] if pts=='0' else [mp.mpf(10)**k for k in (3,4,5,6)]
                r=[abs(g(x)) for x in xs]
                if pts=='0' and not c.get('oneside'): r=[max(a,abs(g(-x))) for a,x in zip(r,xs)]
                got+=1
                if r[3]>8*r[0] and r[3]>1e-9: bad+=1; maxbad=max(maxbad,r[3])
                elif r[3]>2*r[0]+mp.mpf('1e-3'): return None,'unclear growth'
                else: worst=max(worst,r[3])
                continue
            if ex.startswith('bool:'):
                v=bool(eval(ex[5:],ns)); got+=1
                if not v: bad+=1; maxbad=mp.mpf(1)
                continue
            toks=re.split('( == | <= | >= | < | > | != )',ex)
            vals=[eval(t.strip(),ns) for t in toks[::2]]
            if any(isnum_bad(v,cx) for v in vals): continue
        except (Undef,ZeroDivisionError,OverflowError): continue
        got+=1; fail=mp.mpf(0)
        for a,r,b in zip(vals,toks[1::2],vals[1:]):
            r=r.strip()
            if r=='==':
                d=reldiff(a,b)
                if d>tol:
                    fail=max(fail,d)
                else: worst=max(worst,d)
            else:
                d=(a-b) if r in('<=','<') else (b-a) if r in('>=','>') else None
                if d is None: fail=max(fail,mp.mpf(1) if a==b else 0); continue
                sc=max(1,abs(a),abs(b))
                if d>tol*sc: fail=max(fail,d/sc)
                elif r in '<>' and d==0: fail=max(fail,mp.mpf(1))
        if fail>0: bad+=1; maxbad=max(maxbad,fail)
    if got<(1 if nosym else min(20,c.get('need',20))): return None,f'only {got} points'
    what='exact evaluation' if nosym else f'{got} points of the domain'
    if bad==0:
        return True,f"{what} at {dps} digits: holds at all"+(f", largest relative difference {mp.nstr(worst,2)}" if worst else '')
    thr=mp.mpf('1e-4') if f['construct']=='limit' else mp.mpf('1e-6')
    if maxbad>thr: return False,f"{what} at {dps} digits: fails at {bad}, by up to {mp.nstr(maxbad,3)} (relative)"
    return None,f"ambiguous: bad {bad}/{got}, maxbad {mp.nstr(maxbad,5)}"
def load():
    with open(os.path.join(HERE,'formulas.toml'),'rb') as fh: F=tomllib.load(fh)['formula']
    sp=importlib.util.spec_from_file_location('formulas_check',os.path.join(HERE,'formulas_check.py')); m=importlib.util.module_from_spec(sp); sp.loader.exec_module(m)
    return F,m.CHECKS
def main():
    F,C=load(); pre=sys.argv[1] if len(sys.argv)>1 else ''
    ok=0; tot=0
    for f in F:
        if not f['id'].startswith(pre): continue
        tot+=1
        try: v,t=check(f,C[f['id']])
        except Exception as e: v,t=None,f'{type(e).__name__}: {e}'
        if v is not None and v==(f['truth']=='true'): ok+=1
        else: print('NOT CONFIRMED',f['id'],f['truth'],'|',v,'|',t,'|',f['tex'])
    print(f'{ok} of {tot} confirmed')
    from collections import Counter
    cc=Counter((f['construct'],f['truth']) for f in F)
    for k in sorted({a for a,_ in cc}): print(f"  {k:14s} true {cc[k,'true']:3d}  false {cc[k,'false']:3d}")
    print('  all            true',sum(v for (a,b),v in cc.items() if b=='true'),' false',sum(v for (a,b),v in cc.items() if b=='false'))
if __name__=='__main__': main()
